// What the `level` and `pressure` tiers do, as a person sees it, on the serial reference (the GPU equals it
// byte for byte).
#include "reference/water_level.h"

#include <gtest/gtest.h>

#include <random>

#include "unit/water_worlds.h"

namespace tarn {
namespace {

class WaterLevel : public testing::TestWithParam<WaterTier> {
  protected:
    static void run(Cells& cells, int ticks, std::uint32_t seed = 1) {
        tarn::run(cells, GetParam(), ticks, seed);
    }
};

TEST_P(WaterLevel, nothing_leaks_between_closed_cells_that_touch_along_an_edge) {
    for (const auto wall : edge_walls)
        for (const std::uint8_t fluid : {full_water, MATERIAL_SAND})
            for (const int wet : {-1, 1})
                EXPECT_EQ(leaks(GetParam(), wall, wet, MATERIAL_GLASS, fluid, 150), 0)
                    << wall({0, 0, 0}) << ' ' << wall({1, 0, 0});
    EXPECT_EQ(leaks(GetParam(), edge_walls[0], 1, 200, full_water, 150), 0);
}

TEST_P(WaterLevel, differences_of_one_quantum_and_films_rest) {
    std::mt19937 random(3);
    const Cells pool = make_cells({70, 6, 23}, [&](glm::ivec3 c) {
        return c.y < 2 ? full_water : c.y == 2 ? water_cell(7 + random() % 2) : MATERIAL_AIR;
    });
    const Cells wet_floor = make_cells({70, 6, 23}, [&](glm::ivec3 c) {
        return c.y == 0 && c.x > 6 ? water_cell(film - random() % 2) : MATERIAL_AIR;
    });
    for (const Cells& start : {pool, wet_floor}) {
        Cells cells = start;
        run(cells, 200);
        EXPECT_EQ(cells, start);
    }
}

TEST_P(WaterLevel, a_step_in_a_basin_levels_and_rests) {
    const Cells start = make_cells(
        {40, 12, 24}, [](glm::ivec3 c) { return c.y < (c.x < 20 ? 9 : 2) ? full_water : MATERIAL_AIR; });
    reference::Simulation simulation = simulation_of(start);
    simulation.step(450, settings_of(GetParam()));
    EXPECT_EQ(simulation.active_bricks(), 0u);
    // 5.5 layers.
    for_cells(simulation.cells(), [&](glm::ivec3 c) {
        const int quanta = static_cast<int>(quanta_of(simulation.cells().at(c)));
        EXPECT_NEAR(quanta,
                    c.y < 5    ? 16
                    : c.y == 5 ? 8
                               : 0,
                    c.y == 5 ? 3 : 0)
            << c.x << ' ' << c.y << ' ' << c.z;
    });
    EXPECT_EQ(take_census(simulation.cells()).water_quanta, take_census(start).water_quanta);
}

TEST_P(WaterLevel, a_point_source_spreads_roundly) {
    constexpr int seeds = 3;
    double ratio = 0;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        Scene scene;
        scene.seed = seed;
        scene.cells = Cells({64, 10, 64});
        scene.springs = {{.region = {{31, 8, 31}, {33, 9, 33}}, .material = MATERIAL_WATER, .per_tick = 64}};
        reference::Simulation simulation(scene);
        simulation.step(120, settings_of(GetParam()));
        const glm::dvec2 reach = reach_along_axes_and_diagonals(simulation.cells(), MATERIAL_WATER);
        EXPECT_GT(reach.x, 15);
        EXPECT_LT(reach.x, 31);
        ratio += reach.x / reach.y / seeds;
    }
    EXPECT_NEAR(ratio, 1, 0.07);
}

TEST_P(WaterLevel, sand_rests_in_a_pile_of_45_degrees) {
    Cells cells = make_cells({64, 40, 64}, [](glm::ivec3 c) {
        const glm::ivec2 from_axis = glm::abs(2 * glm::ivec2(c.x, c.z) - 63);
        return c.y > 4 && std::max(from_axis.x, from_axis.y) < 5 ? MATERIAL_SAND : MATERIAL_AIR;
    });
    const Census before = take_census(cells);
    reference::Simulation simulation = simulation_of(cells);
    simulation.step(300, settings_of(GetParam()));
    EXPECT_EQ(simulation.active_bricks(), 0u);
    EXPECT_EQ(take_census(simulation.cells()), before);
    EXPECT_LE(steepest_step(simulation.cells(), MATERIAL_SAND), 1);
}

TEST_P(WaterLevel, sand_sinks_to_the_bottom_and_never_rests_on_fluid) {
    std::mt19937 random(5);
    const Cells start = make_cells({24, 16, 24}, [&](glm::ivec3 c) {
        return c.y < 6 ? full_water : c.y < 10 && random() % 3 == 0 ? MATERIAL_SAND : MATERIAL_AIR;
    });
    Cells cells = start;
    run(cells, 300);
    EXPECT_EQ(hanging_sand(cells), 0);
    EXPECT_LE(steepest_step(cells, MATERIAL_SAND), 1);
    EXPECT_EQ(take_census(cells).water_quanta, take_census(start).water_quanta);
    EXPECT_EQ(take_census(cells).voxels[MATERIAL_SAND], take_census(start).voxels[MATERIAL_SAND]);
}

// A ridge of sand between two heights of water.
TEST_P(WaterLevel, resting_sand_dams_water) {
    const auto ridge = [](glm::ivec3 c) { return c.y < 9 - std::abs(c.x - 20); };
    const Cells start = make_cells({40, 12, 21}, [&](glm::ivec3 c) {
        return ridge(c) ? MATERIAL_SAND : c.y < (c.x < 20 ? 8 : 3) ? full_water : MATERIAL_AIR;
    });
    Cells cells = start;
    run(cells, 400);
    EXPECT_EQ(cells, start);
    // Through a gap in the crest it does run over.
    for (int z = 8; z < 12; ++z)
        for (int y = 6; y < 9; ++y)
            for (int x = 17; x < 24; ++x) cells.at({x, y, z}) = MATERIAL_AIR;
    run(cells, 400);
    EXPECT_LT(height_of(cells, 2, 2, MATERIAL_WATER), 8);
    EXPECT_GT(height_of(cells, 37, 2, MATERIAL_WATER), 3);
}

TEST_P(WaterLevel, water_runs_to_a_drop_and_leaves_a_film) {
    Cells cells = make_cells({24, 20, 6}, [](glm::ivec3 c) {
        if (c.x < 12) return c.y < 10 ? MATERIAL_STONE : c.y == 10 ? full_water : MATERIAL_AIR;
        return MATERIAL_AIR;
    });
    run(cells, 600);
    for_cells(cells, [&](glm::ivec3 c) {
        EXPECT_TRUE(c.x >= 12 || quanta_of(cells.at(c)) <= film) << c.x << ' ' << c.y;
    });
    EXPECT_EQ(take_census(cells).water_quanta, 12u * 6 * 16);
}

TEST_P(WaterLevel, solids_of_every_byte_stay) {
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

TEST_P(WaterLevel, a_world_full_of_one_fluid_stays_and_sleeps) {
    for (const std::uint8_t fluid : {full_water, MATERIAL_SAND})
        for (const glm::ivec3 size : {glm::ivec3(33, 17, 20), glm::ivec3(1, 40, 1)}) {
            const Cells start = make_cells(size, [&](glm::ivec3) { return fluid; });
            reference::Simulation simulation = simulation_of(start);
            simulation.step(65, settings_of(GetParam()));
            EXPECT_EQ(simulation.cells(), start);
            EXPECT_EQ(simulation.active_bricks(), 0u);
        }
}

INSTANTIATE_TEST_SUITE_P(Tiers, WaterLevel, testing::Values(WaterTier::Level, WaterTier::Pressure),
                         [](const auto& tier) {
                             return tier.param == WaterTier::Level ? "level" : "pressure";
                         });

}  // namespace
}  // namespace tarn
