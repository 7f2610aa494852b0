// Every built-in scene: nothing is lost or made at any tick (BRIEF fault 1: water appears and disappears),
// and what has no spring comes to rest: in the tier of the scenes each, under pressure those that are about
// it, the others among the long runs. On one driver alone: that both give the same bytes is water_test's
// part.
#include "gpu/conservation.h"
#include "gpu/gl_test.h"
#include "gpu/worlds.h"

namespace tarn {
namespace {

using ScenesTest = GlTest;

TEST_F(ScenesTest, Fault1_WaterNeitherAppearsNorDisappearsInAnyScene) {
    const std::vector<std::string> names = built_in_scenes();
    ASSERT_FALSE(names.empty());
    for (const std::string& name : names) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(name, Settings{});
        gl::Timers timers;
        Simulation simulation(scene, timers);
        expect_kept_books(simulation, scene.settings, take_census(scene.cells), 250, 1);
        const FlowTotals flow = simulation.flow_totals();
        EXPECT_EQ(flow.sprung_water_quanta + flow.sprung_sand_voxels == 0, scene.springs.empty());
        if (HasFatalFailure()) return;
    }
}

TEST_F(ScenesTest, every_scene_without_a_spring_comes_to_rest) {
    int rested = 0;
    for (const std::string& name : built_in_scenes()) {
        const Scene scene = load_scene(name, Settings{});
        if (!scene.springs.empty()) continue;
        for (const WaterTier tier : {WaterTier::Level, WaterTier::Pressure}) {
            if (tier == WaterTier::Pressure && !rests_early_under_pressure(name)) continue;
            SCOPED_TRACE(name + ", " + name_of(tier));
            expect_rest(scene, tier, 1500);
            ++rested;
        }
    }
    EXPECT_GE(rested, 10 + 2);
}

}  // namespace
}  // namespace tarn
