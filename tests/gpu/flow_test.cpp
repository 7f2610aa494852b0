// Springs and drains on the GPU equal the serial reference in every byte and every count.
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "app/simulation.h"
#include "gpu/gl_test.h"
#include "gpu/worlds.h"
#include "passes/flow.h"
#include "reference/simulation.h"
#include "world/schedule.h"

namespace tarn {
namespace {

using FlowTest = GlTest;

FlowTally tally_of(const FlowTotals& t) {
    return {t.sprung_water_quanta, t.drained_water_quanta, t.sprung_sand_voxels, t.drained_sand_voxels};
}

void expect_equal_run(const Scene& scene, WaterTier tier, std::uint64_t first_tick, int ticks,
                      int substeps = 1) {
    SCOPED_TRACE(choice_names<WaterTier>()[static_cast<std::size_t>(tier)]);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    simulation.set_tick(first_tick);
    Settings settings;
    settings.water_tier = tier;
    settings.water_substeps = substeps;
    reference::Simulation reference(scene, first_tick);
    const Census start = take_census(scene.cells);
    for (int i = 0; i < ticks; ++i) {
        simulation.step(1, settings);
        reference.step(1, settings);
        const FlowTally& tally = reference.flow();
        ASSERT_TRUE(same_cells(simulation.read_cells(), reference.cells()))
            << "after tick " << first_tick + i;
        ASSERT_EQ(tally_of(simulation.flow_totals()), tally) << "after tick " << first_tick + i;
        const Census now = take_census(reference.cells());
        ASSERT_EQ(now.water_quanta + tally.drained_water_quanta,
                  start.water_quanta + tally.sprung_water_quanta);
        ASSERT_EQ(now.voxels[MATERIAL_SAND] + tally.drained_sand_voxels,
                  start.voxels[MATERIAL_SAND] + tally.sprung_sand_voxels);
    }
}

Scene flowing_scene(glm::ivec3 size_vox, Soup soup) {
    Scene scene;
    scene.seed = 11;
    scene.cells = make_soup(size_vox, soup, 21);
    const glm::ivec3 top = size_vox - 1;
    scene.springs = {
        {.region = {{0, top.y, 0}, {3, top.y + 1, 2}}, .material = MATERIAL_WATER, .per_tick = 7},
        {.region = {{0, top.y / 2, 0}, size_vox}, .material = MATERIAL_WATER, .per_tick = 1000},
        {.region = {{0, 0, 0}, {2, 2, 2}}, .material = MATERIAL_WATER, .per_tick = 0x80000000u},
        {.region = {top, size_vox}, .material = MATERIAL_SAND, .per_tick = 1},
        {.region = {{0, top.y, 0}, size_vox}, .material = MATERIAL_SAND, .per_tick = 2},
        {.region = {{-5, -5, -5}, {1, 1, 1}}, .material = MATERIAL_WATER, .per_tick = 3},
        {.region = {size_vox, size_vox + 4}, .material = MATERIAL_WATER, .per_tick = 3},
    };
    scene.drains = {{.region = {{0, 0, 0}, {top.x, 1, 2}}}, {.region = {{-3, 0, 0}, {1, 99, 99}}}};
    return scene;
}

TEST_F(FlowTest, equals_reference_in_bytes_and_counts) {
    for (const glm::ivec3 size :
         {glm::ivec3(1, 1, 1), glm::ivec3(7, 13, 5), glm::ivec3(31, 17, 22), glm::ivec3(1, 40, 1)})
        for (const Soup soup : {Soup::AllBytes, Soup::Layers}) {
            SCOPED_TRACE(fmt::format("{}x{}x{}", size.x, size.y, size.z));
            for (const WaterTier tier : {WaterTier::Block, WaterTier::Level, WaterTier::Pressure}) {
                expect_equal_run(flowing_scene(size, soup), tier, 0, 60);
                if (HasFatalFailure()) return;
            }
        }
}

TEST_F(FlowTest, springs_and_drains_run_once_a_tick_of_several_steps) {
    expect_equal_run(flowing_scene({31, 17, 22}, Soup::Layers), WaterTier::Pressure, 0, 30, 3);
}

TEST_F(FlowTest, equals_reference_across_the_tick_counters_wrap) {
    for (const WaterTier tier : {WaterTier::Block, WaterTier::Level, WaterTier::Pressure})
        expect_equal_run(flowing_scene({9, 10, 11}, Soup::Matter), tier, (std::uint64_t{1} << 32) - 10, 20);
}

TEST_F(FlowTest, counts_pass_32_bits) {
    constexpr std::uint64_t near = 0xfffffff0u;
    const FlowPass flow(FlowPass::Counts{near, near + (std::uint64_t{5} << 32), near, near});
    gl::Texture cells({.label = "cells", .format = GL_R8UI, .size = {8, 8, 8}});
    gl::Texture changed({.label = "changed", .format = GL_R32UI, .size = {2, 2, 2}});
    cells.clear();
    const ActivityPass activity({8, 8, 8});
    const FlowPass::Inputs in{.seed = 1, .tick = 0, .version = 1, .activity = activity};
    const FlowPass::Outputs out{.cells = cells, .brick_changed = changed};
    const Box low{{0, 0, 0}, {8, 4, 8}};
    const Box high{{0, 4, 0}, {8, 8, 8}};
    flow.record_springs({{.region = low, .material = MATERIAL_WATER, .per_tick = 0x80000000u},
                         {.region = high, .material = MATERIAL_SAND, .per_tick = 0x80000000u}},
                        in, out);
    flow.record_drains({{.region = {{-1, -1, -1}, {9, 9, 9}}}}, in, out);
    constexpr std::uint64_t voxels = 256;  // of either half
    EXPECT_EQ(flow.counts(),
              (FlowPass::Counts{near + 16 * voxels, near + (std::uint64_t{5} << 32) + 16 * voxels,
                                near + voxels, near + voxels}));
}

// Refreshes until the counts are those of the cells, or for too long.
void expect_census_of_cells(Simulation& simulation) {
    const Census now = take_census(simulation.read_cells());
    const auto start = std::chrono::steady_clock::now();
    static double clock_s = 0;
    const double start_s = clock_s;
    while (simulation.recent_census() != now && clock_s - start_s < 20) {
        clock_s = start_s + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        simulation.refresh_census(clock_s);
    }
    EXPECT_EQ(simulation.recent_census(), now);
}

TEST_F(FlowTest, census_arrives_without_being_waited_for) {
    Scene scene;
    scene.cells = make_soup({61, 37, 45}, Soup::AllBytes, 5);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    EXPECT_EQ(simulation.recent_census(), take_census(scene.cells));
    simulation.step(30, Settings{});
    EXPECT_NE(take_census(simulation.read_cells()), take_census(scene.cells)) << "amounts of water change";
    expect_census_of_cells(simulation);
}

// Only tiles in which something changed are counted anew.
TEST_F(FlowTest, census_follows_ticks_edits_undo_and_loading) {
    Scene scene;
    scene.cells = make_soup({99, 70, 37}, Soup::Matter, 7);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    EditHistory history;
    std::mt19937 random(3);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int round = 0; round < 8; ++round) {
        if (round == 1) simulation.put_to_sleep();
        history.begin_stroke();
        for (int i = 0; i < 3; ++i)
            simulation.apply(
                {.tick = simulation.tick(),
                 .center_vox = {below(99), below(70), below(37)},
                 .radius_vox = 1 + below(4),
                 .material = static_cast<std::uint8_t>(round % 2 == 0 ? MATERIAL_LAMP : MATERIAL_AIR),
                 .overwrite = true},
                history);
        if (round % 3 == 2) simulation.write(*history.undo());
        if (round % 2 == 1) simulation.step(1 + below(4), Settings{});
        expect_census_of_cells(simulation);
    }
    simulation.write_cells(make_soup({99, 70, 37}, Soup::Layers, 8));
    simulation.step(2, Settings{});
    expect_census_of_cells(simulation);
}

}  // namespace
}  // namespace tarn
