// The long run of conservation_test: 10,000 ticks of every built-in scene, a minute or so a scene without a
// GPU. It runs by its own command: ctest -C soak -L soak.
#include <fmt/format.h>

#include <cstdio>

#include "gpu/conservation.h"
#include "gpu/gl_test.h"

namespace tarn {
namespace {

using SoakTest = GlTest;

TEST_F(SoakTest, every_scene_keeps_its_water_and_sand_for_10000_ticks) {
    for (const std::string& name : built_in_scenes()) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(name, Settings{});
        gl::Timers timers;
        Simulation simulation(scene, timers);
        const Census initial = take_census(scene.cells);
        expect_kept_books(simulation, scene.settings, initial, 10000, 50);
        if (HasFatalFailure()) return;
        const Census now = take_census(simulation.read_cells());
        const FlowTotals flow = simulation.flow_totals();
        fmt::print("{:10} tick {}: water {} = {} + {} sprung - {} drained; sand {} = {} + {} - {}\n", name,
                   simulation.tick(), now.water_quanta, initial.water_quanta, flow.sprung_water_quanta,
                   flow.drained_water_quanta, now.voxels[MATERIAL_SAND], initial.voxels[MATERIAL_SAND],
                   flow.sprung_sand_voxels, flow.drained_sand_voxels);
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace tarn
