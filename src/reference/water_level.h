// The `level` and `pressure` tiers of the water in plain serial code: what glsl/pass/level_*.comp must do,
// byte for byte.
#pragma once
#include <cstdint>

#include "reference/activity.h"
#include "reference/pressure_field.h"
#include "world/cells.h"

namespace tarn::reference {

// One step, `tick` counts them. `film_threshold` in quanta; `field`, whose own sweeps have run, makes it the
// pressure tier. `activity.begin_tick()` has been called; changes are told to it. Any byte is
// allowed: those that are not air, sand or water are solid, as is what lies outside the world.
void water_level_tick(Cells& cells, std::uint32_t seed, std::uint32_t tick, int film_threshold,
                      Activity& activity, PressureField* field);

}  // namespace tarn::reference
