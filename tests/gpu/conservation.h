// The books of a built-in scene: water (quanta) and sand (voxels) against what springs made and drains took.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/simulation.h"
#include "core/assets.h"
#include "gpu/worlds.h"

namespace tarn {

inline std::vector<std::string> built_in_scenes() {
    std::vector<std::string> names;
    for (const std::string& path : list_assets("assets/scenes")) {
        const std::size_t start = path.find_last_of('/') + 1;
        names.push_back(path.substr(start, path.find_last_of('.') - start));
    }
    return names;
}

// Runs `ticks` ticks, looking every `interval`: count = initial + sprung - drained + placed - removed,
// exactly, and every other material as it was.
inline void expect_kept_books(Simulation& simulation, const Settings& settings, const Census& initial,
                              int ticks, int interval) {
    for (int done = 0; done < ticks; done += interval) {
        simulation.step(interval, settings);
        const Census now = take_census(simulation.read_cells());
        const FlowTotals flow = simulation.flow_totals();
        const EditTotals& edits = simulation.edit_totals();
        ASSERT_EQ(now.water_quanta, initial.water_quanta + flow.sprung_water_quanta -
                                        flow.drained_water_quanta + edits.placed.water_quanta -
                                        edits.removed.water_quanta)
            << "water after tick " << simulation.tick();
        for (std::size_t id = 1; id < now.voxels.size(); ++id) {
            if (id == MATERIAL_WATER) continue;
            std::uint64_t expected = initial.voxels[id] + edits.placed.voxels[id] - edits.removed.voxels[id];
            if (id == MATERIAL_SAND) expected += flow.sprung_sand_voxels - flow.drained_sand_voxels;
            ASSERT_EQ(now.voxels[id], expected) << "material " << id << " after tick " << simulation.tick();
        }
    }
}

// Those of the built-in scenes whose rest under pressure is among the tests of every day: what pressure is
// for, and a wave. The others are among the long runs.
inline bool rests_early_under_pressure(const std::string& name) {
    return name == "u-tube" || name == "dam-break";
}

// Runs until nothing is active, at most `ticks`: then nothing changes any more, and the water is what it was.
inline void expect_rest(const Scene& scene, WaterTier tier, std::uint64_t ticks) {
    gl::Timers timers;
    Simulation simulation(scene, timers);
    Settings settings = scene.settings;
    settings.water_tier = tier;
    while (simulation.active_bricks() > 0 && simulation.tick() < ticks) simulation.step(50, settings);
    EXPECT_EQ(simulation.active_bricks(), 0u);
    const std::uint32_t last_change = simulation.last_change();
    const Cells cells = simulation.read_cells();
    simulation.step(100, settings);
    EXPECT_TRUE(same_cells(simulation.read_cells(), cells));
    EXPECT_EQ(simulation.last_change(), last_change);
    EXPECT_EQ(take_census(cells).water_quanta, take_census(scene.cells).water_quanta);
}

}  // namespace tarn
