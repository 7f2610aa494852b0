// Ticks without pictures, with a bar.
#pragma once
#include <cstdint>

#include "app/simulation.h"

namespace tarn {

// Waits for the GPU now and then: so that the bar shows what is done, and timer queries do not pile up.
void run_ticks(Simulation& simulation, const Settings& settings, std::uint64_t ticks, gl::Timers& timers);

}  // namespace tarn
