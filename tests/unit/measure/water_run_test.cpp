// Scenarios as they are placed, and runs of them on steppers whose water moves by a script.
#include "measure/water_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "measure/water_metrics.h"

namespace tarn {
namespace {

double figure(const WaterRun& run, const std::string& name) {
    for (const Figure& found : run.figures)
        if (found.name == name) return found.value;
    ADD_FAILURE() << "no figure " << name;
    return std::nan("");
}

TEST(WaterScenarios, PlaceWhatTheirDrawingsSay) {
    // In voxels of water and of sand, counted from the boxes of each drawing.
    const std::map<std::string, std::pair<int, int>> placed = {
        {"dam", {32 * 24 * 64, 0}},
        {"blob", {16 * 16 * 16, 0}},
        {"spill", {30 * 20 * 64, 0}},
        {"utube", {8 * 32 * 8 + 32 * 4 * 8, 0}},
        {"ulong", {8 * 32 * 8 + 160 * 4 * 8, 0}},
        {"uthin", {8 * 32 * 8 + 160 * 1 * 2, 0}},
        {"riser", {24 * 24 * 24 + 12 * 2 * 2, 0}},
        {"tall-arm", {24 * 12 * 24 + 10 * 2 * 2 + 2 * 36 * 2, 0}},
        {"tap", {2 * 8 * 10 * 8 + 32 * 4 * 8, 0}},
        {"point", {0, 0}},
        {"sand", {48 * 12 * 48, 8 * 24 * 8}},
        {"drain", {64 * 6 * 64, 0}},
        {"shafts", {61 * 3 * 45, 0}},
        {"bigdam", {80 * 16 * 96, 0}}};
    EXPECT_EQ(water_scenarios().size(), placed.size());
    for (const WaterScenario& scenario : water_scenarios()) {
        const Scene scene = scene_of(scenario, 7);
        EXPECT_EQ(scene.seed, 7u);
        const Mass mass = mass_of(scene.cells);
        EXPECT_EQ(mass.water_quanta, 16u * placed.at(scenario.name).first) << scenario.name;
        EXPECT_EQ(mass.sand_voxels, std::uint64_t(placed.at(scenario.name).second)) << scenario.name;
        EXPECT_EQ(find_water_scenario(scenario.name), &scenario);
    }
    EXPECT_EQ(find_water_scenario("atlantis"), nullptr);
}

TEST(WaterScenarios, ShaftsAreTwelveOneWideAndReachNearTheFloor) {
    const Cells cells = find_water_scenario("shafts")->build();
    int shafts = 0;
    for (int z = 1; z < 44; ++z)
        for (int x = 1; x < 60; ++x) {
            if (cells.at({x, 1, z}) != MATERIAL_AIR) continue;
            ++shafts;
            EXPECT_EQ(cells.at({x, 0, z}), MATERIAL_STONE);
            for (const auto& [dx, dz] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                EXPECT_EQ(cells.at({x + dx, 1, z + dz}), MATERIAL_STONE) << x << " " << z;
        }
    EXPECT_EQ(shafts, 12);
}

// Water that a function of the tick moves; what is written to it stays.
class Scripted : public WaterStepper {
  public:
    using Script = std::function<void(Cells&, int)>;
    Scripted(Cells cells, Script script) : cells_(std::move(cells)), script_(std::move(script)) {}
    void tick() override { script_(cells_, tick_++); }
    Cells read() override { return cells_; }
    void write(const std::vector<CellChange>& changes) override {
        for (const CellChange& change : changes) {
            EXPECT_EQ(cells_.at(change.cell), change.before);
            cells_.at(change.cell) = change.after;
        }
    }

  private:
    Cells cells_;
    Script script_;
    int tick_ = 0;
};

WaterRun run_scripted(const WaterScenario& scenario, const Scripted::Script& script, int ticks_limit = 0) {
    const MakeStepper make = [&](const Scene& scene, const StepperOptions&) {
        return std::make_unique<Scripted>(scene.cells, script);
    };
    return run_water(scenario, 1, make,
                     {.stepper = {.settings = {.water_tier = WaterTier::Block}}, .ticks_limit = ticks_limit});
}

// Two columns of a world of 2x4x1: `good` while they differ by at most 1.
WaterScenario two_columns() {
    return {.name = "two",
            .what = "",
            .ticks_max = 400,
            .build =
                [] {
                    Cells cells({2, 4, 1});
                    for (int y = 0; y < 4; ++y) cells.at({0, y, 0}) = MATERIAL_WATER_FULL;
                    return cells;
                },
            .level = LevelMeasure{.goal = "within_1_vox_from_tick",
                                  .value =
                                      [](const Cells& cells) {
                                          return mean_depth_vox(cells, {{0, 0, 0}, {1, 4, 1}}) -
                                                 mean_depth_vox(cells, {{1, 0, 0}, {2, 4, 1}});
                                      },
                                  .limit = 1,
                                  .axis = "",
                                  .false_head = true},
            .at_end = [](const Cells&) { return std::vector<Figure>{}; }};
}

void set_heights(Cells& cells, int left, int right) {
    for (int y = 0; y < 4; ++y) {
        cells.at({0, y, 0}) = y < left ? MATERIAL_WATER_FULL : MATERIAL_AIR;
        cells.at({1, y, 0}) = y < right ? MATERIAL_WATER_FULL : MATERIAL_AIR;
    }
}

TEST(WaterRun, FindsRestLevelAndFalseHead) {
    const WaterRun run = run_scripted(two_columns(), [](Cells& cells, int tick) {
        if (tick == 10) set_heights(cells, 2, 2);
        if (tick == 20) set_heights(cells, 1, 3);  // out again: level must count anew
        if (tick == 30) set_heights(cells, 2, 2);
    });
    EXPECT_EQ(figure(run, "within_1_vox_from_tick"), 30);
    EXPECT_EQ(figure(run, "at_rest_from_tick"), 31);
    EXPECT_EQ(figure(run, "ticks"), 31 + 64 + 4);
    EXPECT_EQ(figure(run, "false_head_vox"), 2);
    EXPECT_EQ(figure(run, "mass_off"), 0);
    // Moved: 2 voxels, then 1, then 1.
    EXPECT_DOUBLE_EQ(figure(run, "quanta_moved_per_tick"), 4 * 16.0 / 99);
    ASSERT_EQ(run.level_error.size(), 99u);
    EXPECT_EQ(run.level_error[9], glm::dvec2(9, 4));
    EXPECT_EQ(run.level_error[25], glm::dvec2(25, 2));
}

TEST(WaterRun, SaysNeverWhereRestOrLevelDoNotCome) {
    const WaterRun run = run_scripted(two_columns(), [](Cells& cells, int tick) {
        set_heights(cells, tick % 60 < 59 ? 4 : 3, tick % 60 < 59 ? 0 : 1);
    });
    EXPECT_TRUE(std::isinf(figure(run, "at_rest_from_tick")));
    EXPECT_TRUE(std::isinf(figure(run, "within_1_vox_from_tick")));
    EXPECT_EQ(figure(run, "ticks"), 400);
    EXPECT_EQ(figure(run_scripted(
                         two_columns(), [](Cells&, int) {}, 50),
                     "ticks"),
              50);
}

TEST(WaterRun, SeesMassThatWasAwayForOneTick) {
    const WaterRun water = run_scripted(two_columns(), [](Cells& cells, int tick) {
        if (tick == 5) cells.at({0, 3, 0}) = static_cast<std::uint8_t>(water_cell(13));
        if (tick == 6) cells.at({0, 3, 0}) = MATERIAL_WATER_FULL;
    });
    EXPECT_EQ(figure(water, "mass_off"), 3);
    const WaterRun sand = run_scripted(two_columns(), [](Cells& cells, int tick) {
        if (tick == 5) cells.at({1, 0, 0}) = MATERIAL_SAND;
    });
    EXPECT_EQ(figure(sand, "mass_off"), 1);
}

TEST(WaterRun, CountsWhatATapPoursAndWhatAnOpeningTakes) {
    WaterScenario scenario = two_columns();
    scenario.tap = WaterTap{{{1, 3, 0}, {2, 4, 1}}, 3};
    // What is poured falls one cell at a time out of the tap's; it finds no room the third time.
    scenario.at_end = [](const Cells& cells) {
        return std::vector<Figure>{{"volume_vox", mean_depth_vox(cells, {{1, 0, 0}, {2, 4, 1}})}};
    };
    const auto fall = [](Cells& cells, int) {
        if (cells.at({1, 0, 0}) == MATERIAL_AIR) std::swap(cells.at({1, 0, 0}), cells.at({1, 3, 0}));
    };
    WaterRun run = run_scripted(scenario, fall);
    EXPECT_EQ(figure(run, "volume_vox"), 2);
    EXPECT_EQ(figure(run, "mass_off"), 0);

    scenario.tap.reset();
    scenario.opening = Box{{0, 2, 0}, {1, 4, 1}};
    run = run_scripted(scenario, [](Cells&, int) {});
    EXPECT_EQ(figure(run, "closed_rest_from_tick"), 0);
    EXPECT_EQ(figure(run, "ticks"), 2 * (64 + 4));
    EXPECT_EQ(figure(run, "mass_off"), 0);
    EXPECT_EQ(run.level_error.size(), 68u);
    EXPECT_EQ(run.level_error[0].y, 2);
}

// The serial reference levels a small drop; the command measures it without a GPU.
TEST(WaterRun, StepsTheReference) {
    const WaterRun run =
        run_water(*find_water_scenario("tap"), 1, make_reference_stepper,
                  {.stepper = {.settings = {.water_tier = WaterTier::Block}}, .ticks_limit = 40});
    EXPECT_EQ(run.tier, "block");
    EXPECT_EQ(run.scenario, "tap");
    EXPECT_EQ(figure(run, "mass_off"), 0);
    EXPECT_EQ(figure(run, "ticks"), 40);
    EXPECT_GT(figure(run, "left_arm_vox"), 10.5);
    EXPECT_EQ(figure(run, "right_arm_vox"), 10);
}

}  // namespace
}  // namespace tarn
