// Nothing is lost or made, with springs, drains and edits. Of every built-in scene: scenes_test, and
// tests/soak.
#include "gpu/conservation.h"

#include "gpu/gl_test.h"
#include "gpu/worlds.h"

namespace tarn {
namespace {

using ConservationTest = GlTest;

TEST_F(ConservationTest, springs_drains_and_edits_balance) {
    Scene scene;
    scene.cells = make_soup({45, 40, 37}, Soup::Layers, 8);
    scene.springs = {{.region = {{10, 38, 10}, {20, 40, 20}}, .material = MATERIAL_WATER, .per_tick = 777},
                     {.region = {{30, 39, 10}, {33, 40, 14}}, .material = MATERIAL_SAND, .per_tick = 5}};
    scene.drains = {{.region = {{0, 0, 0}, {45, 1, 9}}}};
    gl::Timers timers;
    Simulation simulation(scene, timers);
    const Census initial = take_census(scene.cells);
    EditHistory history;
    for (int round = 0; round < 12; ++round) {
        history.begin_stroke();
        simulation.apply({.tick = simulation.tick(),
                          .center_vox = {round * 4, 5 + round * 3, 36 - round * 3},
                          .radius_vox = 6,
                          .material = round % 3 == 0   ? std::uint8_t{MATERIAL_WATER}
                                      : round % 3 == 1 ? std::uint8_t{MATERIAL_SAND}
                                                       : std::uint8_t{MATERIAL_AIR},
                          .overwrite = round % 2 == 0},
                         history);
        expect_kept_books(simulation, Settings{}, initial, 20, 4);
        if (round % 4 == 3)
            if (const auto changes = history.undo()) simulation.write(*changes);
        expect_kept_books(simulation, Settings{}, initial, 2, 1);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(simulation.flow_totals().sprung_water_quanta, 0u);
    EXPECT_GT(simulation.flow_totals().drained_water_quanta, 0u);
    EXPECT_GT(simulation.flow_totals().sprung_sand_voxels, 0u);
}

}  // namespace
}  // namespace tarn
