// Small worlds for tests of the water's serial reference, and what is read off them.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "reference/simulation.h"
#include "world/cells.h"

namespace tarn {

constexpr int film = 3;
constexpr std::uint8_t full_water = MATERIAL_WATER_FULL;

template <typename Act>
void for_cells(const Cells& cells, const Act& act) {
    const glm::ivec3 size = cells.size_vox();
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) act(glm::ivec3(x, y, z));
}

template <typename Fill>
Cells make_cells(glm::ivec3 size_vox, const Fill& fill) {
    Cells cells(size_vox);
    for_cells(cells, [&](glm::ivec3 c) { cells.at(c) = static_cast<std::uint8_t>(fill(c)); });
    return cells;
}

inline Settings settings_of(WaterTier tier) {
    Settings settings;
    settings.water_tier = tier;
    settings.film_threshold = film;
    return settings;
}

inline reference::Simulation simulation_of(const Cells& cells, std::uint32_t seed = 1) {
    Scene scene;
    scene.cells = cells;
    scene.seed = seed;
    return reference::Simulation(scene);
}

inline void run(Cells& cells, WaterTier tier, int ticks, std::uint32_t seed = 1) {
    reference::Simulation simulation = simulation_of(cells, seed);
    simulation.step(ticks, settings_of(tier));
    cells = simulation.cells();
}

// Height of the topmost `material` in a column, 0 if none.
inline int height_of(const Cells& cells, int x, int z, std::uint32_t material) {
    int height = 0;
    for (int y = 0; y < cells.size_vox().y; ++y)
        if (material_of(cells.at({x, y, z})) == material) height = y + 1;
    return height;
}

// Largest difference in height of `material` between columns that touch by a side.
inline int steepest_step(const Cells& cells, std::uint32_t material) {
    int steepest = 0;
    for (int z = 0; z + 1 < cells.size_vox().z; ++z)
        for (int x = 0; x + 1 < cells.size_vox().x; ++x) {
            const int height = height_of(cells, x, z, material);
            steepest = std::max({steepest, std::abs(height - height_of(cells, x + 1, z, material)),
                                 std::abs(height - height_of(cells, x, z + 1, material))});
        }
    return steepest;
}

// Cells of sand over what is not sand, nor a solid, nor the floor.
inline int hanging_sand(const Cells& cells) {
    int hanging = 0;
    for_cells(cells, [&](glm::ivec3 c) {
        if (cells.at(c) != MATERIAL_SAND || c.y == 0) return;
        const std::uint8_t below = cells.at(c - glm::ivec3(0, 1, 0));
        hanging += below == MATERIAL_AIR || is_water(below) ? 1 : 0;
    });
    return hanging;
}

// The furthest that `material` reached from the axis (31.5, 31.5) within 11 degrees of the axes and
// diagonals.
inline glm::dvec2 reach_along_axes_and_diagonals(const Cells& cells, std::uint32_t material) {
    glm::dvec2 reach(0);
    for_cells(cells, [&](glm::ivec3 c) {
        if (material_of(cells.at(c)) != material) return;
        const double x = c.x - 31.5;
        const double z = c.z - 31.5;
        const double along = std::cos(4 * std::atan2(z, x));
        if (along > 0.7) reach.x = std::max(reach.x, std::hypot(x, z));
        if (along < -0.7) reach.y = std::max(reach.y, std::hypot(x, z));
    });
    return reach;
}

// Walls one cell thick whose cells touch along edges only, across all pairs of axes: 0 in the wall, its sign
// tells the sides, in a world of 16 x 18 x 16.
constexpr int (*edge_walls[])(glm::ivec3) = {
    +[](glm::ivec3 c) { return c.x + c.z - 15; }, +[](glm::ivec3 c) { return c.x - c.z; },
    +[](glm::ivec3 c) { return c.x + c.y - 15; }, +[](glm::ivec3 c) { return c.x - c.y; },
    +[](glm::ivec3 c) { return c.z + c.y - 15; }, +[](glm::ivec3 c) { return c.z - c.y; }};

// Cells that changed on the dry side of such a wall or in it after `ticks`; the wet side, where the sign of
// the wall's function is that of `wet`, began full of `fluid` up to layer 15.
inline int leaks(WaterTier tier, int (*wall)(glm::ivec3), int wet, std::uint8_t solid, std::uint8_t fluid,
                 int ticks) {
    const Cells start = make_cells({16, 18, 16}, [&](glm::ivec3 c) {
        const int side = wall(c) * wet;
        return side == 0 ? solid : side > 0 && c.y < 15 ? fluid : MATERIAL_AIR;
    });
    Cells cells = start;
    run(cells, tier, ticks);
    int leaked = 0;
    for_cells(cells, [&](glm::ivec3 c) { leaked += wall(c) * wet <= 0 && cells.at(c) != start.at(c); });
    return leaked;
}

}  // namespace tarn
