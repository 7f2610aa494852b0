#include "passes/temporal_pass.h"

#include "shared/bindings.h"

namespace tarn {

namespace {

gl::ProgramDesc describe(bool blend, bool moments, bool upsample) {
    gl::ProgramDesc desc{.label = blend ? "temporal blend" : "temporal",
                         .compute = {},
                         .vertex = "pass/fullscreen.vert",
                         .fragment = "pass/temporal.frag",
                         .defines = {}};
    if (blend) desc.defines.emplace_back("HISTORY_BLEND", "1");
    if (upsample) desc.defines.emplace_back("HISTORY_UPSAMPLE", "1");
    if (moments) desc.defines.emplace_back("HISTORY_MOMENTS", "1");
    return desc;
}

}  // namespace

TemporalPass::TemporalPass(bool blend, bool moments, bool upsample)
    : blend_(blend), moments_(moments), upsample_(upsample), program_(describe(blend, moments, upsample)) {}

void TemporalPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("temporal");
    inputs.brick_changed.bind_image(IMAGE_BRICK_CHANGED, GL_READ_ONLY);
    if (upsample_) inputs.cells.bind_image(IMAGE_CELLS, GL_READ_ONLY);
    inputs.current.radiance.bind_image(IMAGE_RADIANCE, GL_READ_ONLY);
    inputs.current.surface.bind_image(IMAGE_SURFACE, GL_READ_ONLY);
    inputs.previous.radiance.bind_image(IMAGE_PREVIOUS_RADIANCE, GL_READ_ONLY);
    inputs.previous.surface.bind_image(IMAGE_PREVIOUS_SURFACE, GL_READ_ONLY);
    inputs.rejected.bind_storage(0);
    if (!blend_) {
        if (inputs.retraced != nullptr) {
            inputs.retraced->bind(BINDING_FIRST_INPUT + 5);
            inputs.traced_before->bind(BINDING_FIRST_INPUT + 6);
        }
        program_.set("retrace_stride", inputs.retrace_stride);
    }
    if (moments_) {
        if (inputs.previous_moments != nullptr) inputs.previous_moments->bind(BINDING_FIRST_INPUT + 4);
        program_.set("has_moments", inputs.previous_moments != nullptr ? 1 : 0);
    }
    program_.set("new_pixel_samples", static_cast<float>(inputs.new_pixel_samples));
    program_.set("previous_version", inputs.previous_version);
    program_.use();
    outputs.history.draw_fullscreen();
}

}  // namespace tarn
