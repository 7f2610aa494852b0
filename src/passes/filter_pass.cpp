#include "passes/filter_pass.h"

#include "shared/bindings.h"

namespace tarn {

FilterPass::FilterPass(bool gaussian)
    : program_({.label = gaussian ? "filter gaussian" : "filter",
                .compute = {},
                .vertex = "pass/fullscreen.vert",
                .fragment = "pass/filter.frag",
                .defines = gaussian
                               ? std::vector<std::pair<std::string, std::string>>{{"FILTER_GAUSSIAN", "1"}}
                               : std::vector<std::pair<std::string, std::string>>{}}),
      gaussian_(gaussian) {}

void FilterPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("filter");
    inputs.surfaces.radiance.bind_image(IMAGE_RADIANCE, GL_READ_ONLY);
    if (!gaussian_) inputs.surfaces.surface.bind_image(IMAGE_SURFACE, GL_READ_ONLY);
    program_.set("step_px", inputs.step_px);
    program_.use();
    outputs.target.draw_fullscreen();
}

}  // namespace tarn
