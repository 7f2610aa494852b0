#include "passes/head_field.h"

#include "shared/bindings.h"

namespace tarn {

namespace {

constexpr std::size_t clock_words = 9;  // HeadClock of glsl/lib/head_clock.glsl
constexpr std::size_t publish_arguments = 3 * sizeof(std::uint32_t);

void barrier() {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace

HeadFieldPass::HeadFieldPass(glm::ivec3 size_vox)
    : clock_({.label = "head clock", .compute = "pass/head_clock.comp"}),
      publish_({.label = "head publish", .compute = "pass/head_publish.comp"}),
      sweep_({.label = "head sweep", .compute = "pass/head_sweep.comp"}),
      acting_({.label = "acting head", .format = GL_R32UI, .size = size_vox}),
      building_({.label = "building head", .format = GL_R32UI, .size = size_vox}),
      clock_state_("head clock", clock_words * sizeof(std::uint32_t)) {
    acting_.clear();
    building_.clear();
}

void HeadFieldPass::record(const Inputs& in) {
    const glm::ivec3 size_vox = acting_.size();
    in.activity.bind(publish_, in.tick);
    clock_state_.bind_storage(STORAGE_HEAD_CLOCK);
    acting_.bind_image(IMAGE_ACTING_HEAD, GL_READ_WRITE);
    building_.bind_image(IMAGE_BUILDING_HEAD, GL_READ_WRITE);
    in.cells.bind(BINDING_CELLS);
    clock_.set("size_vox", size_vox);
    publish_.set("size_vox", size_vox);
    sweep_.set("size_vox", size_vox);
    sweep_.set("film_threshold", in.film_threshold);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, clock_state_.name());
    for (int i = 0; i < in.sweeps; ++i) {
        clock_.dispatch({1, 1, 1});
        barrier();
        publish_.use();
        glDispatchComputeIndirect(publish_arguments);
        barrier();
        sweep_.use();
        glDispatchComputeIndirect(0);
        barrier();
    }
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

void HeadFieldPass::poll_reload(std::vector<std::string>& messages) {
    for (gl::Program* program : {&clock_, &publish_, &sweep_})
        if (auto message = program->poll_reload()) messages.push_back(*message);
}

}  // namespace tarn
