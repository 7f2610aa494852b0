// One scenario of water, stepped to rest or to its last tick, with its books checked at every tick. Owns the
// rules of the measurement; the stepper owns the water.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "measure/water_scenarios.h"
#include "measure/water_stepper.h"

namespace tarn {

// Where plots of level errors begin: a quantum is 1/16 of a voxel; means over an arm or a pool resolve less.
constexpr double lowest_error_vox = 0.01;

struct WaterRun {
    std::string tier, scenario;
    std::uint32_t seed = 1;
    std::vector<Figure> figures = {};
    // (tick, absolute value of the scenario's level measure); empty where it has none.
    std::vector<glm::dvec2> level_error = {};
    const char* level_axis = "";
    double level_limit = 0;
};

struct WaterRunOptions {
    StepperOptions stepper;
    int ticks_limit = 0;                     // 0: the scenario's own
    std::function<void(int)> progress = {};  // after each tick, with the count of those done
};

// Ticks without a change after which water counts as at rest: more where a field may act after a while.
int quiet_ticks(WaterTier tier);

WaterRun run_water(const WaterScenario& scenario, std::uint32_t seed, const MakeStepper& make,
                   const WaterRunOptions& options);

}  // namespace tarn
