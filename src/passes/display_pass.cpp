#include "passes/display_pass.h"

#include "shared/bindings.h"

namespace tarn {

namespace {

gl::ProgramDesc describe(bool radiance_only, bool guided) {
    gl::ProgramDesc desc{.label = radiance_only ? "display radiance" : "display",
                         .compute = {},
                         .vertex = "pass/fullscreen.vert",
                         .fragment = "pass/display.frag",
                         .defines = {}};
    if (radiance_only) desc.defines.emplace_back("DISPLAY_RADIANCE", "1");
    if (guided) desc.defines.emplace_back("DISPLAY_GUIDED", "1");
    return desc;
}

}  // namespace

DisplayPass::DisplayPass(bool radiance_only, bool guided)
    : guided_(guided), program_(describe(radiance_only, guided)) {}

void DisplayPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("display");
    inputs.radiance.bind(BINDING_FIRST_INPUT);
    if (guided_) {
        inputs.surface.bind(BINDING_FIRST_INPUT + 1);
        inputs.cells.bind(BINDING_CELLS);
    }
    program_.use();
    outputs.picture.draw_fullscreen();
}

}  // namespace tarn
