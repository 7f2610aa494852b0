// What the `block` tier does, as a person sees it, on the serial reference (the GPU equals it byte for byte).
#include "reference/water_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tarn {
namespace {

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

void run(Cells& cells, std::uint32_t ticks, std::uint32_t seed = 1) {
    reference::Activity activity(cells.size_vox());
    for (std::uint32_t tick = 0; tick < ticks; ++tick) {
        activity.begin_tick();
        reference::water_block_tick(cells, seed, tick, film, activity);
    }
}

// Height of the topmost `material` in a column, 0 if none.
int height_of(const Cells& cells, int x, int z, std::uint32_t material) {
    int height = 0;
    for (int y = 0; y < cells.size_vox().y; ++y)
        if (material_of(cells.at({x, y, z})) == material) height = y + 1;
    return height;
}

// The furthest that `material` reached from the axis (31.5, 31.5) within 11 degrees of the axes and
// diagonals.
glm::dvec2 reach_along_axes_and_diagonals(const Cells& cells, std::uint32_t material) {
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

TEST(WaterBlock, nothing_leaks_between_closed_cells_that_touch_along_an_edge) {
    // Walls one cell thick whose cells touch along edges only: across x and z, and across x and y both ways.
    const auto sides = {+[](glm::ivec3 c) { return c.x + c.z - 15; }, +[](glm::ivec3 c) { return c.x - c.z; },
                        +[](glm::ivec3 c) { return c.x + c.y - 15; }, +[](glm::ivec3 c) { return c.x - c.y; },
                        +[](glm::ivec3 c) { return c.z - c.y; }};
    for (const auto side : sides)
        for (const std::uint8_t solid : {MATERIAL_GLASS, std::uint8_t{200}})
            for (const std::uint8_t fluid : {full_water, MATERIAL_SAND})
                for (const int wet : {-1, 1}) {
                    Cells cells = make_cells({16, 18, 16}, [&](glm::ivec3 c) {
                        const int s = side(c) * wet;
                        return s == 0 ? solid : s > 0 && c.y < 15 ? fluid : MATERIAL_AIR;
                    });
                    run(cells, 200);
                    for_cells(cells, [&](glm::ivec3 c) {
                        const int s = side(c) * wet;
                        ASSERT_TRUE(s > 0 || cells.at(c) == (s == 0 ? solid : MATERIAL_AIR))
                            << c.x << ' ' << c.y << ' ' << c.z;
                    });
                }
}

TEST(WaterBlock, differences_of_one_quantum_and_films_rest) {
    std::mt19937 random(3);
    const Cells pool = make_cells({19, 6, 23}, [&](glm::ivec3 c) {
        return c.y < 2 ? full_water : c.y == 2 ? water_cell(7 + random() % 2) : MATERIAL_AIR;
    });
    const Cells wet_floor = make_cells({19, 6, 23}, [&](glm::ivec3 c) {
        return c.y == 0 && c.x > 6 ? water_cell(film - random() % 2) : MATERIAL_AIR;
    });
    for (const Cells& start : {pool, wet_floor}) {
        Cells cells = start;
        run(cells, 200);
        EXPECT_EQ(cells, start);
    }
}

TEST(WaterBlock, spreads_evenly_in_all_directions) {
    Cells cells({64, 10, 64});
    reference::Activity activity(cells.size_vox());
    activity.set_always_awake(true);
    for (std::uint32_t tick = 0; tick < 700; ++tick) {
        for (int i = 0; i < 4 && tick < 180; ++i) {
            std::uint8_t& byte = cells.at({31 + i % 2, 8, 31 + i / 2});
            if (byte == MATERIAL_AIR) byte = full_water;
        }
        activity.begin_tick();
        reference::water_block_tick(cells, 5, tick, film, activity);
    }
    const glm::dvec2 reach = reach_along_axes_and_diagonals(cells, MATERIAL_WATER);
    EXPECT_GT(reach.x, 10);
    EXPECT_NEAR(reach.x / reach.y, 1, 0.15);
}

TEST(WaterBlock, sand_rests_in_a_round_pile_of_45_degrees) {
    Cells cells = make_cells({64, 40, 64}, [](glm::ivec3 c) {
        const glm::ivec2 from_axis = glm::abs(2 * glm::ivec2(c.x, c.z) - 63);
        return c.y > 4 && std::max(from_axis.x, from_axis.y) < 5 ? MATERIAL_SAND : MATERIAL_AIR;
    });
    const Census before = take_census(cells);
    run(cells, 400);
    EXPECT_EQ(take_census(cells), before);
    for (int z = 0; z < 63; ++z)
        for (int x = 0; x < 63; ++x) {
            const int height = height_of(cells, x, z, MATERIAL_SAND);
            EXPECT_LE(std::abs(height - height_of(cells, x + 1, z, MATERIAL_SAND)), 1) << x << ' ' << z;
            EXPECT_LE(std::abs(height - height_of(cells, x, z + 1, MATERIAL_SAND)), 1) << x << ' ' << z;
        }
    const glm::dvec2 reach = reach_along_axes_and_diagonals(cells, MATERIAL_SAND);
    EXPECT_NEAR(reach.x / reach.y, 1, 0.15);
    const Cells rested = cells;
    run(cells, 100, 1);
    EXPECT_EQ(cells, rested);
}

TEST(WaterBlock, sand_sinks_and_water_rises_by_as_much) {
    Cells cells = make_cells({9, 12, 9}, [](glm::ivec3 c) {
        return c.y < 6 ? full_water : c.y == 10 && c.x == 4 ? MATERIAL_SAND : MATERIAL_AIR;
    });
    const Census before = take_census(cells);
    run(cells, 300);
    EXPECT_EQ(take_census(cells).voxels[MATERIAL_SAND], before.voxels[MATERIAL_SAND]);
    EXPECT_EQ(take_census(cells).water_quanta, before.water_quanta);
    for_cells(cells, [&](glm::ivec3 c) {
        const bool hangs =
            cells.at(c) == MATERIAL_SAND && c.y > 0 && cells.at(c - glm::ivec3(0, 1, 0)) != MATERIAL_SAND;
        EXPECT_FALSE(hangs) << c.x << ' ' << c.y << ' ' << c.z;
    });
}

TEST(WaterBlock, water_runs_to_a_drop_and_fills_what_is_below) {
    // A shelf of water over a pit. What stays is a film, and what the rest of one quantum a cell holds back.
    Cells cells = make_cells({24, 20, 6}, [](glm::ivec3 c) {
        if (c.x < 12) return c.y < 10 ? MATERIAL_STONE : c.y == 10 ? full_water : MATERIAL_AIR;
        return MATERIAL_AIR;
    });
    run(cells, 1500);
    for_cells(cells, [&](glm::ivec3 c) {
        if (c.x >= 12) return;
        EXPECT_LE(static_cast<int>(quanta_of(cells.at(c))), 2 * film + 11 - c.x) << c.x << ' ' << c.y;
    });
    EXPECT_EQ(take_census(cells).water_quanta, 12u * 6 * 16);
}

TEST(WaterBlock, solids_of_every_byte_stay) {
    std::mt19937 random(9);
    Cells cells = make_cells({17, 15, 13}, [&](glm::ivec3) { return random() % 256; });
    const Cells before = cells;
    run(cells, 200, 0xffffffffu);
    for_cells(cells, [&](glm::ivec3 c) {
        const std::uint32_t was = before.at(c);
        if (was == MATERIAL_AIR || was == MATERIAL_SAND || is_water(was)) return;
        ASSERT_EQ(cells.at(c), was);
    });
    EXPECT_EQ(take_census(cells).water_quanta, take_census(before).water_quanta);
}

}  // namespace
}  // namespace tarn
