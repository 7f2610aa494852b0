// Springs and drains in plain serial code: what glsl/pass/flow.comp must do, byte and count for count.
#pragma once
#include <cstdint>
#include <vector>

#include "world/cells.h"
#include "world/scene.h"

namespace tarn {

struct FlowTally {
    std::uint64_t sprung_water_quanta = 0, drained_water_quanta = 0;
    std::uint64_t sprung_sand_voxels = 0, drained_sand_voxels = 0;
    bool operator==(const FlowTally&) const = default;
};

// Before the water's step, in the order of the list.
void springs_tick(Cells& cells, const std::vector<Spring>& springs, std::uint32_t seed, std::uint32_t tick,
                  FlowTally& tally);
// After it.
void drains_tick(Cells& cells, const std::vector<Drain>& drains, FlowTally& tally);

}  // namespace tarn
