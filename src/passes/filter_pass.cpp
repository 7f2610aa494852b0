#include "passes/filter_pass.h"

#include "shared/bindings.h"

namespace tarn {

namespace {

gl::ProgramDesc describe(FilterPass::Kind kind) {
    constexpr const char* labels[] = {"filter", "filter moving", "filter gaussian"};
    gl::ProgramDesc desc{.label = labels[static_cast<int>(kind)],
                         .compute = {},
                         .vertex = "pass/fullscreen.vert",
                         .fragment = "pass/filter.frag",
                         .defines = {}};
    if (kind == FilterPass::Kind::Gaussian) desc.defines.emplace_back("FILTER_GAUSSIAN", "1");
    if (kind == FilterPass::Kind::Moving) desc.defines.emplace_back("FILTER_MOVING", "1");
    return desc;
}

}  // namespace

FilterPass::FilterPass(Kind kind) : program_(describe(kind)), kind_(kind) {}

void FilterPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("filter");
    inputs.surfaces.radiance.bind_image(IMAGE_RADIANCE, GL_READ_ONLY);
    if (kind_ != Kind::Gaussian) inputs.surfaces.surface.bind_image(IMAGE_SURFACE, GL_READ_ONLY);
    program_.set("step_px", inputs.step_px);
    program_.use();
    outputs.target.draw_fullscreen();
}

}  // namespace tarn
