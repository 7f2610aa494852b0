#include "passes/block_step.h"

#include "shared/bindings.h"
#include "shared/hash.h"
#include "shared/water.h"
#include "world/schedule.h"

namespace tarn {

BlockStepPass::BlockStepPass() : program_({.label = "block step", .compute = "pass/block_step.comp"}) {}

BlockGrid BlockStepPass::grid(std::uint32_t seed, std::uint32_t tick) {
    return {glm::ivec3(BLOCK_TILE), block_offset_vox(seed, tick, glm::ivec3(2))};
}

void BlockStepPass::record(const Inputs& in, const Outputs& out) const {
    const glm::ivec3 size = out.cells.size();
    const BlockGrid tiles = grid(in.seed, in.tick);
    program_.set("size_vox", size);
    program_.set("offset_vox", tiles.offset_vox);
    program_.set("count_tiles", tiles.count(size));
    program_.set("seed", in.seed);
    program_.set("tick_key", hash2(in.seed, in.tick));
    program_.set("film_threshold", in.film_threshold);
    program_.set("version", in.version);
    out.cells.bind_image(IMAGE_CELLS, GL_READ_WRITE);
    out.brick_changed.bind_image(IMAGE_BRICK_CHANGED, GL_READ_WRITE);
    in.activity.run_blocks(program_, 0, in.tick);
}

}  // namespace tarn
