#include "passes/error_pass.h"

#include <array>
#include <glm/glm.hpp>

#include "core/error.h"
#include "shared/bindings.h"
#include "shared/error.h"

namespace tarn {

ErrorPass::ErrorPass()
    : mean_({.label = "error mean", .compute = "pass/error.comp", .defines = {{"ERROR_MEAN", "1"}}}),
      relative_({.label = "error", .compute = "pass/error.comp"}),
      sums_("error sums", ERROR_GROUPS * sizeof(glm::vec4)) {}

ErrorPass::~ErrorPass() {
    discard();
}

void ErrorPass::discard() {
    if (fence_ != nullptr) glDeleteSync(fence_);
    fence_ = nullptr;
}

void ErrorPass::record(const Inputs& inputs, gl::Timers& timers) {
    CHECK(!pending());
    const auto scope = timers.scope("error");
    inputs.variance.bind(BINDING_FIRST_INPUT);
    inputs.radiance.bind(BINDING_FIRST_INPUT + 1);
    sums_.bind_storage(0);
    mean_.dispatch({ERROR_GROUPS, 1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    relative_.dispatch({ERROR_GROUPS, 1, 1});
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

std::optional<double> ErrorPass::take(bool wait) {
    if (!pending()) return std::nullopt;
    const GLenum state = glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    const bool arrived = state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
    if (!arrived && !wait) return std::nullopt;
    discard();
    std::array<glm::vec4, ERROR_GROUPS> sums{};
    sums_.download(std::span<glm::vec4>(sums));
    double relative = 0;
    double pixels = 0;
    for (const glm::vec4& sum : sums) {
        relative += sum.y;
        pixels += sum.z;
    }
    return pixels > 0 ? relative / pixels : -1;
}

}  // namespace tarn
