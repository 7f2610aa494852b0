#include "passes/display_pass.h"

#include "core/error.h"
#include "shared/bindings.h"

namespace tarn {

namespace {

gl::ProgramDesc describe(bool radiance_only, bool refined) {
    gl::ProgramDesc desc{.label = radiance_only ? "display radiance" : "display",
                         .compute = {},
                         .vertex = "pass/fullscreen.vert",
                         .fragment = "pass/display.frag",
                         .defines = {}};
    if (radiance_only) desc.defines.emplace_back("DISPLAY_RADIANCE", "1");
    if (refined) desc.defines.emplace_back("DISPLAY_REFINED", "1");
    return desc;
}

}  // namespace

DisplayPass::DisplayPass(bool radiance_only, bool refined)
    : refined_(refined), program_(describe(radiance_only, refined)) {}

void DisplayPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("display");
    inputs.radiance.bind_image(IMAGE_RADIANCE, GL_READ_ONLY);
    if (refined_) {
        CHECK(inputs.exact_mean != nullptr && inputs.exact_sum != nullptr);
        inputs.exact_mean->bind(BINDING_FIRST_INPUT);
        inputs.exact_sum->bind(BINDING_FIRST_INPUT + 1);
        program_.set("exact_samples", static_cast<float>(inputs.exact_samples));
    }
    program_.use();
    outputs.picture.draw_fullscreen();
}

}  // namespace tarn
