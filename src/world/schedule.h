// Data that the GPU passes and the CPU references of the simulation share, computed here once: where the
// blocks of a tick lie and how a spring spreads over its cells. Owns no rule.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "world/scene.h"

namespace tarn {

// Along each axis, the blocks of `block_vox` cells of this tick begin at -offset + k * block, 0 <= offset <
// block. Every run of n ticks from a multiple of n uses each offset of an axis with block side n once, in an
// order that depends on (seed, run, axis); the axes are independent. Sides are powers of two up to 64, so
// that the runs stay whole where the tick wraps at 2^32.
glm::ivec3 block_offset_vox(std::uint32_t seed, std::uint32_t tick, glm::ivec3 block_vox);

// Cell i (x fastest, then y, then z) of a spring's n cells gets base + 1 where (i * stride + phase) mod n <
// rest, else base; over all cells that is exactly `per_tick`. No step of it leaves 32 bits.
struct SpringShare {
    std::uint32_t n = 0, base = 0, rest = 0, stride = 1, phase = 0;
};
SpringShare spring_share(std::uint32_t per_tick, std::uint64_t n, std::uint32_t seed, std::uint32_t tick,
                         std::uint32_t index);

// The part of `box` inside a world of `size_vox`; volume 0 where there is none.
Box clipped(const Box& box, glm::ivec3 size_vox);

}  // namespace tarn
