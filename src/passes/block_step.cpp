#include "passes/block_step.h"

#include "shared/hash.h"
#include "world/schedule.h"

namespace tarn {

BlockStepPass::BlockStepPass() : program_({.label = "block step", .compute = "pass/block_step.comp"}) {}

void BlockStepPass::record(const Inputs& in, const Outputs& out) const {
    const glm::ivec3 size = out.cells.size();
    const glm::ivec3 offset = block_offset_vox(in.seed, in.tick, glm::ivec3(2));
    program_.set("size_vox", size);
    program_.set("offset_vox", offset);
    program_.set("seed", in.seed);
    program_.set("tick_key", hash2(in.seed, in.tick));
    program_.set("film_threshold", in.film_threshold);
    program_.set("version", in.version);
    out.cells.bind_image(0, GL_READ_WRITE);
    out.brick_changed.bind_image(1, GL_WRITE_ONLY);
    program_.dispatch_for((size + offset + 1) / 2, {8, 8, 4});
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace tarn
