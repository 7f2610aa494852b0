#include "passes/view_pass.h"

#include "shared/bindings.h"

namespace tarn {

namespace {

gl::ProgramDesc describe(ViewKind view, History history, bool raw) {
    gl::ProgramDesc desc{.label = "view",
                         .compute = {},
                         .vertex = "pass/fullscreen.vert",
                         .fragment = "pass/view.frag",
                         .defines = {{"SHOWN_VIEW", std::to_string(static_cast<int>(view))}}};
    if (history == History::Exact) desc.defines.emplace_back("VIEW_EXACT", "1");
    if (history == History::None) desc.defines.emplace_back("VIEW_SINGLE", "1");
    if (raw) desc.defines.emplace_back("VIEW_RAW", "1");
    return desc;
}

}  // namespace

ViewPass::ViewPass(ViewKind view, History history, bool raw) : program_(describe(view, history, raw)) {}

void ViewPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("view");
    GLuint unit = BINDING_FIRST_INPUT;
    for (const gl::Texture* texture :
         {&inputs.surface, inputs.counts, inputs.history, inputs.moments, inputs.correction}) {
        if (texture != nullptr) texture->bind(unit);
        ++unit;
    }
    program_.use();
    outputs.picture.draw_fullscreen();
}

}  // namespace tarn
