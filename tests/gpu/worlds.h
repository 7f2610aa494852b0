// Worlds for tests of the simulation: random ones, and a comparison that names the first difference.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "core/settings.h"
#include "world/cells.h"

namespace tarn {

inline const char* name_of(WaterTier tier) {
    return choice_names<WaterTier>()[static_cast<std::size_t>(tier)];
}

// Whether two worlds agree; names the first cell that differs.
inline testing::AssertionResult same_cells(const Cells& gpu, const Cells& reference) {
    if (gpu == reference) return testing::AssertionSuccess();
    const glm::ivec3 size = reference.size_vox();
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (gpu.at({x, y, z}) != reference.at({x, y, z}))
                    return testing::AssertionFailure()
                           << fmt::format("cell ({}, {}, {}) of {}x{}x{}: GPU {}, reference {}", x, y, z,
                                          size.x, size.y, size.z, gpu.at({x, y, z}), reference.at({x, y, z}));
    return testing::AssertionFailure() << "sizes differ";
}

// Every byte alike; what moves and a solid; water of any amount; shelves with holes, sand and water between.
enum class Soup { AllBytes, Matter, Water, Layers };

inline Cells make_soup(glm::ivec3 size_vox, Soup soup, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    Cells cells(size_vox);
    std::size_t i = 0;
    for (std::uint8_t& byte : cells.bytes()) {
        const std::size_t shelf = i++ / size_vox.x % size_vox.y % 7;
        std::uint32_t made = water_cell(below(17));
        if (soup == Soup::AllBytes) {
            made = below(256);
        } else if (soup == Soup::Matter) {
            made = std::array<std::uint32_t, 5>{MATERIAL_AIR, MATERIAL_SAND, MATERIAL_STONE, made,
                                                MATERIAL_WATER_FULL}[below(5)];
        } else if (soup == Soup::Layers && shelf <= 3) {
            const std::uint32_t floor = below(3) == 0 ? MATERIAL_AIR : MATERIAL_GLASS;
            made = shelf == 0 ? floor : shelf == 3 ? MATERIAL_SAND : MATERIAL_AIR;
        }
        byte = static_cast<std::uint8_t>(made);
    }
    return cells;
}

}  // namespace tarn
