// The `block` tier of the water in plain serial code: what glsl/pass/block_step.comp must do, byte for byte.
#pragma once
#include <cstdint>

#include "reference/activity.h"
#include "world/cells.h"

namespace tarn::reference {

// One step, `tick` counts them. `film_threshold` in quanta. `activity.begin_tick()` has been called; changes
// are told to it. Any byte is allowed in `cells`: those that are not air, sand or water are solid, as is what
// lies outside the world.
void water_block_tick(Cells& cells, std::uint32_t seed, std::uint32_t tick, int film_threshold,
                      Activity& activity);

}  // namespace tarn::reference
