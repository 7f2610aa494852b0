// What a tick of each tier costs: worlds of a given side with a dam that has burst, with a still pool that is
// kept awake, and with the same pool asleep.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "measure/water_stepper.h"

namespace tarn {

struct SpeedRow {
    std::string tier, stepper, state;  // stepper: gpu or reference; state: moving, awake, asleep
    int side_vox = 0;
    double tick_ms = 0;                // median over the rounds
    double quanta_moved_per_tick = 0;  // in the same ticks
};

// Rounds in turn over everything that is compared, so that a machine's other work weighs on all alike. Needs
// a current context. `progress` is called with the share done.
std::vector<SpeedRow> measure_water_speed(const std::vector<std::string>& tiers,
                                          const std::vector<int>& sides_vox, int rounds,
                                          const std::function<void(double)>& progress);

std::string speed_text(const std::vector<SpeedRow>& rows);
std::string speed_csv(const std::vector<SpeedRow>& rows);

}  // namespace tarn
