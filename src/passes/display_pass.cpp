#include "passes/display_pass.h"

#include "shared/bindings.h"

namespace tarn {

DisplayPass::DisplayPass(bool radiance_only)
    : program_({.label = radiance_only ? "display radiance" : "display",
                .compute = {},
                .vertex = "pass/fullscreen.vert",
                .fragment = "pass/display.frag",
                .defines = radiance_only
                               ? std::vector<std::pair<std::string, std::string>>{{"DISPLAY_RADIANCE", "1"}}
                               : std::vector<std::pair<std::string, std::string>>{}}) {}

void DisplayPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("display");
    inputs.radiance.bind(BINDING_FIRST_INPUT);
    program_.use();
    outputs.picture.draw_fullscreen();
}

}  // namespace tarn
