// What the `block` tier does, as a person sees it, on the serial reference (the GPU equals it byte for byte).
#include "reference/water_block.h"

#include <gtest/gtest.h>

#include <random>

#include "unit/water_worlds.h"

namespace tarn {
namespace {

void run(Cells& cells, int ticks, std::uint32_t seed = 1) {
    run(cells, WaterTier::Block, ticks, seed);
}

TEST(WaterBlock, nothing_leaks_between_closed_cells_that_touch_along_an_edge) {
    for (const auto wall : edge_walls)
        for (const std::uint8_t solid : {MATERIAL_GLASS, std::uint8_t{200}})
            for (const std::uint8_t fluid : {full_water, MATERIAL_SAND})
                for (const int wet : {-1, 1})
                    EXPECT_EQ(leaks(WaterTier::Block, wall, wet, solid, fluid, 200), 0)
                        << wall({0, 0, 0}) << ' ' << wall({1, 0, 0});
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
    EXPECT_LE(steepest_step(cells, MATERIAL_SAND), 1);
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
    EXPECT_EQ(hanging_sand(cells), 0);
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
