// The cells of a world on the CPU: one byte each (glsl/shared/materials.h), x fastest, then y, then z, as in
// the texture. Owns the bytes; knows no rules.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "shared/materials.h"

namespace tarn {

constexpr int world_side_max_vox = 1024;

class Cells {
  public:
    Cells() = default;
    explicit Cells(glm::ivec3 size_vox)
        : size_(size_vox), bytes_(std::size_t{1} * size_vox.x * size_vox.y * size_vox.z, MATERIAL_AIR) {}

    glm::ivec3 size_vox() const { return size_; }
    std::size_t count() const { return bytes_.size(); }
    bool contains(glm::ivec3 cell) const {
        return static_cast<unsigned>(cell.x) < static_cast<unsigned>(size_.x) &&
               static_cast<unsigned>(cell.y) < static_cast<unsigned>(size_.y) &&
               static_cast<unsigned>(cell.z) < static_cast<unsigned>(size_.z);
    }
    std::size_t index(glm::ivec3 cell) const {
        return cell.x + std::size_t{1} * size_.x * (cell.y + std::size_t{1} * size_.y * cell.z);
    }
    std::uint8_t at(glm::ivec3 cell) const { return bytes_[index(cell)]; }
    std::uint8_t& at(glm::ivec3 cell) { return bytes_[index(cell)]; }
    // The byte, or `outside` beyond the world.
    std::uint8_t get(glm::ivec3 cell, std::uint8_t outside) const {
        return contains(cell) ? at(cell) : outside;
    }

    const std::vector<std::uint8_t>& bytes() const { return bytes_; }
    std::vector<std::uint8_t>& bytes() { return bytes_; }
    bool operator==(const Cells&) const = default;

  private:
    glm::ivec3 size_{0};
    std::vector<std::uint8_t> bytes_;
};

// Voxels by material id (water under MATERIAL_WATER whatever its amount), and quanta of water.
struct Census {
    std::array<std::uint64_t, MATERIAL_COUNT> voxels{};
    std::uint64_t water_quanta = 0;
    bool operator==(const Census&) const = default;
};
Census take_census(const Cells& cells);

// 64-bit hash of size and bytes (FNV-1a), for comparing worlds across runs.
std::uint64_t hash_of(const Cells& cells);

}  // namespace tarn
