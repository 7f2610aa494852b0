// What a run says of itself in JSON: the world's counts, times, driver, settings. Owns nothing.
#pragma once
#include <string>

#include "app/simulation.h"
#include "core/settings.h"
#include "gl/timers.h"
#include "world/scene.h"

namespace tarn {

struct StatsInputs {
    const Scene& scene;
    const Simulation& simulation;
    const Settings& settings;
    gl::Timers& timers;
    double compile_ms = 0;               // of the programs of the picture
    std::uint64_t rejected_samples = 0;  // not finite
    std::uint64_t samples = 0;           // per pixel of the picture, 0 without one
};

// Waits for the GPU. `counts` are voxels by material name, `water_quanta` sixteenths of a voxel,
// `active_bricks` those of 4x4x4 voxels with a change in the last 64 ticks, `cells_hash` the FNV-1a hash of
// size and bytes; flow and edits are totals since the scene was loaded; all counts are 64-bit.
std::string stats_json(const StatsInputs& inputs);

}  // namespace tarn
