// What C++ knows of glsl/lib/work_list.glsl: lists of items, made by one dispatch for another.
#pragma once
#include <array>
#include <cstdint>

namespace tarn {

constexpr std::size_t word_bytes = sizeof(std::uint32_t);
constexpr std::size_t work_header_words = 4;
constexpr std::array<std::uint32_t, work_header_words> empty_work_list{0, 0, 1, 0};  // WorkHeader
constexpr std::size_t work_groups_per_row = 32768;                                   // WORK_GROUPS_PER_ROW

}  // namespace tarn
