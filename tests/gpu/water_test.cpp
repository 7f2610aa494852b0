// The water's step on the GPU equals the serial reference in every byte, whatever the world holds.
#include <gtest/gtest.h>

#include <array>

#include "app/simulation.h"
#include "gpu/gl_test.h"
#include "gpu/worlds.h"
#include "reference/simulation.h"
#include "shared/water.h"

namespace tarn {
namespace {

using WaterTest = GlTest;

constexpr std::array tiers{WaterTier::Block, WaterTier::Level, WaterTier::Pressure};

struct Run {
    glm::ivec3 size_vox{1};
    Soup soup = Soup::Matter;
    std::uint32_t seed = 1;
    std::uint64_t first_tick = 0;
    int ticks = 100;
    int ticks_between_looks = 10;
    int film_threshold = 3;
    int substeps = 1, sweeps = 1;
};

void expect_equal_steps(WaterTier tier, const Run& run) {
    SCOPED_TRACE(
        fmt::format("{}, size {}x{}x{}, soup {}, seed {}, from tick {}, film {}, substeps {}, sweeps {}",
                    choice_names<WaterTier>()[static_cast<std::size_t>(tier)], run.size_vox.x, run.size_vox.y,
                    run.size_vox.z, static_cast<int>(run.soup), run.seed, run.first_tick, run.film_threshold,
                    run.substeps, run.sweeps));
    Scene scene;
    scene.seed = run.seed;
    scene.cells = make_soup(run.size_vox, run.soup, run.seed * 977 + 13);
    Settings settings;
    settings.water_tier = tier;
    settings.film_threshold = run.film_threshold;
    settings.water_substeps = run.substeps;
    settings.pressure_sweeps = run.sweeps;
    gl::Timers timers;
    Simulation simulation(scene, timers);
    simulation.set_tick(run.first_tick);
    reference::Simulation reference(scene, run.first_tick);
    for (int done = 0; done < run.ticks; done += run.ticks_between_looks) {
        simulation.step(run.ticks_between_looks, settings);
        reference.step(run.ticks_between_looks, settings);
        ASSERT_TRUE(same_cells(simulation.read_cells(), reference.cells()))
            << "after tick " << reference.tick() - 1;
    }
    EXPECT_EQ(simulation.tick(), run.first_tick + run.ticks);
    const Census start = take_census(scene.cells);
    const Census end = take_census(reference.cells());
    EXPECT_EQ(end.water_quanta, start.water_quanta);
    EXPECT_EQ(end.voxels[MATERIAL_SAND], start.voxels[MATERIAL_SAND]);
}

TEST_F(WaterTest, equals_reference_for_odd_sizes_and_seeds) {
    for (const WaterTier tier : tiers)
        for (const glm::ivec3 size : {glm::ivec3(1, 1, 1), glm::ivec3(2, 2, 2), glm::ivec3(7, 13, 5),
                                      glm::ivec3(1, 40, 1), glm::ivec3(61, 29, 27)})
            for (const Soup soup : {Soup::AllBytes, Soup::Matter, Soup::Water, Soup::Layers}) {
                const bool large = size.x > 32;
                for (const std::uint32_t seed : {1u, 77u, 0xffffffffu}) {
                    if (seed != 1u && (size != glm::ivec3(7, 13, 5) || soup != Soup::Matter)) continue;
                    expect_equal_steps(tier, {.size_vox = size,
                                              .soup = soup,
                                              .seed = seed,
                                              .ticks = large ? 20 : 60,
                                              .ticks_between_looks = large ? 10 : 5});
                    if (HasFatalFailure()) return;
                }
            }
}

// Long enough to fall asleep, and to be woken by heads that arrive.
TEST_F(WaterTest, equals_reference_for_thousands_of_ticks) {
    for (const WaterTier tier : tiers)
        expect_equal_steps(tier, {.size_vox = {23, 19, 21},
                                  .soup = Soup::Layers,
                                  .seed = 5,
                                  .ticks = 3000,
                                  .ticks_between_looks = 250});
}

TEST_F(WaterTest, equals_reference_for_hundreds_of_ticks_of_a_large_world) {
    for (const WaterTier tier : tiers)
        expect_equal_steps(tier, {.size_vox = {64, 32, 32},
                                  .soup = Soup::Layers,
                                  .seed = 5,
                                  .first_tick = 1000,
                                  .ticks = 100,
                                  .ticks_between_looks = 25});
}

TEST_F(WaterTest, equals_reference_across_the_tick_counters_wrap) {
    constexpr std::uint64_t wrap = std::uint64_t{1} << 32;
    for (const WaterTier tier : tiers)
        for (const Soup soup : {Soup::Matter, Soup::Water}) {
            expect_equal_steps(tier, {.size_vox = {7, 13, 5},
                                      .soup = soup,
                                      .seed = 3,
                                      .first_tick = wrap - 150,
                                      .ticks = 300,
                                      .ticks_between_looks = 1});
            expect_equal_steps(tier, {.size_vox = {21, 16, 19},
                                      .soup = soup,
                                      .seed = 3,
                                      .first_tick = (wrap << 7) - 7,
                                      .ticks = 20,
                                      .ticks_between_looks = 1});
        }
}

TEST_F(WaterTest, equals_reference_for_several_steps_and_sweeps_in_a_tick) {
    for (const WaterTier tier : tiers)
        for (const glm::ivec2 effort : {glm::ivec2(3, 1), glm::ivec2(1, 5), glm::ivec2(2, 2)})
            expect_equal_steps(tier, {.size_vox = {23, 19, 21},
                                      .soup = Soup::Layers,
                                      .seed = 5,
                                      .ticks = 120,
                                      .ticks_between_looks = 30,
                                      .substeps = effort.x,
                                      .sweeps = effort.y});
}

TEST_F(WaterTest, equals_reference_for_every_film_threshold) {
    for (const WaterTier tier : tiers)
        for (const int film : {1, 2, 5, 16})
            expect_equal_steps(tier, {.size_vox = {19, 12, 23},
                                      .soup = Soup::Water,
                                      .seed = 9,
                                      .ticks = 60,
                                      .film_threshold = film});
}

TEST_F(WaterTest, same_seed_gives_the_same_bytes_and_another_does_not) {
    const auto run = [](std::uint32_t seed) {
        Scene scene;
        scene.seed = seed;
        scene.cells = make_soup({24, 24, 24}, Soup::Matter, 4);
        gl::Timers timers;
        Simulation simulation(scene, timers);
        simulation.step(50, Settings{});
        return hash_of(simulation.read_cells());
    };
    EXPECT_EQ(run(1), run(1));
    EXPECT_NE(run(1), run(2));
}

TEST_F(WaterTest, equals_reference_in_worlds_of_one_row) {
    for (const WaterTier tier : tiers)
        for (const int n : {2, 300})
            for (const glm::ivec3 size : {glm::ivec3(1, n, 1), glm::ivec3(n, 1, 1), glm::ivec3(1, 1, n)})
                for (const Soup soup : {Soup::Matter, Soup::Water}) {
                    expect_equal_steps(tier, {.size_vox = size, .soup = soup, .seed = 2, .ticks = 50});
                    if (HasFatalFailure()) return;
                }
}

TEST_F(WaterTest, worlds_full_of_water_or_sand_stay_and_sleep) {
    for (const WaterTier tier : tiers)
        for (const std::uint8_t matter : {std::uint8_t{MATERIAL_WATER_FULL}, std::uint8_t{MATERIAL_SAND}})
            for (const glm::ivec3 size :
                 {glm::ivec3(40, 24, 33), glm::ivec3(1, 300, 1), glm::ivec3(1, 1, 300)}) {
                SCOPED_TRACE(
                    fmt::format("tier {}, matter {}, height {}", static_cast<int>(tier), matter, size.y));
                Scene scene;
                scene.cells = Cells(size);
                for (std::uint8_t& byte : scene.cells.bytes()) byte = matter;
                Settings settings;
                settings.water_tier = tier;
                gl::Timers timers;
                Simulation simulation(scene, timers);
                const std::uint32_t last_change = simulation.last_change();
                simulation.step(SLEEP_TICKS, settings);
                EXPECT_GT(simulation.active_bricks(), 0u);
                simulation.step(1, settings);
                EXPECT_EQ(simulation.active_bricks(), 0u);
                EXPECT_TRUE(same_cells(simulation.read_cells(), scene.cells));
                EXPECT_EQ(simulation.last_change(), last_change);
            }
}

TEST_F(WaterTest, springs_beyond_all_bounds_and_drains_equal_the_reference) {
    for (const WaterTier tier : tiers)
        for (const std::uint32_t per_tick : {0x80000000u, 0xffffffffu})
            for (const glm::ivec3 size : {glm::ivec3(21, 15, 18), glm::ivec3(1, 40, 1)}) {
                SCOPED_TRACE(
                    fmt::format("tier {}, per tick {}, height {}", static_cast<int>(tier), per_tick, size.y));
                Scene scene;
                scene.cells = make_soup(size, Soup::Layers, 6);
                const glm::ivec3 most = size;
                scene.springs = {
                    {.region = {{0, size.y - 2, 0}, most}, .material = MATERIAL_WATER, .per_tick = per_tick},
                    {.region = {{0, size.y / 2, 0}, {1, size.y / 2 + 1, 1}},
                     .material = MATERIAL_SAND,
                     .per_tick = per_tick}};
                scene.drains = {{.region = {{0, 0, 0}, {size.x, 2, size.z}}}};
                Settings settings;
                settings.water_tier = tier;
                gl::Timers timers;
                Simulation simulation(scene, timers);
                reference::Simulation reference(scene);
                const Census start = take_census(scene.cells);
                for (int round = 0; round < 10; ++round) {
                    simulation.step(12, settings);
                    reference.step(12, settings);
                    const Cells cells = simulation.read_cells();
                    ASSERT_TRUE(same_cells(cells, reference.cells())) << "tick " << simulation.tick();
                    const FlowTotals flow = simulation.flow_totals();
                    EXPECT_EQ(flow.sprung_water_quanta, reference.flow().sprung_water_quanta);
                    EXPECT_EQ(flow.drained_sand_voxels, reference.flow().drained_sand_voxels);
                    EXPECT_EQ(take_census(cells).water_quanta,
                              start.water_quanta + flow.sprung_water_quanta - flow.drained_water_quanta);
                }
                EXPECT_GT(simulation.flow_totals().sprung_water_quanta, 0u);
                EXPECT_GT(simulation.flow_totals().drained_water_quanta, 0u);
            }
}

// What a player sees: a basin fills its holes, nothing hangs in the air, sand lies below water.
TEST_F(WaterTest, water_falls_into_shafts_and_sand_sinks) {
    Scene scene;
    scene.cells = Cells({24, 24, 24});
    for (int z = 0; z < 24; ++z)
        for (int x = 0; x < 24; ++x)
            for (int y = 0; y < 24; ++y)
                scene.cells.at({x, y, z}) = y < 8                        ? MATERIAL_STONE
                                            : y < 12                     ? std::uint8_t{MATERIAL_WATER_FULL}
                                            : y == 20 && x > 8 && x < 12 ? MATERIAL_SAND
                                                                         : MATERIAL_AIR;
    for (int y = 0; y < 8; ++y) scene.cells.at({3, y, 17}) = MATERIAL_AIR;
    for (const WaterTier tier : tiers) {
        SCOPED_TRACE(choice_names<WaterTier>()[static_cast<std::size_t>(tier)]);
        gl::Timers timers;
        Simulation simulation(scene, timers);
        Settings settings;
        settings.water_tier = tier;
        simulation.step(200, settings);
        const Cells cells = simulation.read_cells();
        for (int y = 0; y < 8; ++y) EXPECT_EQ(cells.at({3, y, 17}), MATERIAL_WATER_FULL) << y;
        for (int z = 0; z < 24; ++z)
            for (int x = 0; x < 24; ++x)
                for (int y = 1; y < 24; ++y) {
                    if (cells.at({x, y, z}) != MATERIAL_SAND) continue;
                    const std::uint8_t below = cells.at({x, y - 1, z});
                    EXPECT_TRUE(below == MATERIAL_STONE || below == MATERIAL_SAND)
                        << x << ' ' << y << ' ' << z;
                }
    }
}

}  // namespace
}  // namespace tarn
