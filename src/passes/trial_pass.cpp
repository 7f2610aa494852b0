#include "passes/trial_pass.h"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>

#include "core/error.h"
#include "shared/bindings.h"
#include "shared/trial.h"

namespace tarn {

TrialPass::TrialPass()
    : mean_({.label = "trial mean", .compute = "pass/trial.comp", .defines = {{"TRIAL_MEAN", "1"}}}),
      relative_({.label = "trial", .compute = "pass/trial.comp"}),
      sums_("trial sums", TRIAL_GROUPS * sizeof(glm::vec4)) {}

TrialPass::~TrialPass() {
    discard();
}

void TrialPass::discard() {
    if (fence_ != nullptr) glDeleteSync(fence_);
    fence_ = nullptr;
}

void TrialPass::record(const Inputs& inputs, gl::Timers& timers) {
    CHECK(!pending());
    const auto scope = timers.scope("trial");
    inputs.picture.bind(BINDING_FIRST_INPUT);
    inputs.sample_a.bind(BINDING_FIRST_INPUT + 1);
    inputs.sample_b.bind(BINDING_FIRST_INPUT + 2);
    sums_.bind_storage(0);
    mean_.dispatch({TRIAL_GROUPS, 1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    relative_.set("stride", inputs.stride);
    relative_.dispatch({TRIAL_GROUPS, 1, 1});
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

std::optional<Trial> TrialPass::take(bool wait) {
    if (!pending()) return std::nullopt;
    const GLenum state = glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    const bool arrived = state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
    if (!arrived && !wait) return std::nullopt;
    discard();
    std::array<glm::vec4, TRIAL_GROUPS> sums{};
    sums_.download(std::span<glm::vec4>(sums));
    glm::dvec3 total(0);  // relative error, its square, pixels
    for (const glm::vec4& sum : sums) total += glm::dvec3(sum.y, sum.z, sum.w);
    if (!(total.z > 0)) return std::nullopt;
    const double error = total.x / total.z;
    return Trial{error, std::max(0.0, total.y / total.z - error * error) / total.z};
}

}  // namespace tarn
