#include "passes/temporal_pass.h"

#include "shared/bindings.h"

namespace tarn {

TemporalPass::TemporalPass(bool blend)
    : program_({.label = blend ? "temporal blend" : "temporal",
                .compute = {},
                .vertex = "pass/fullscreen.vert",
                .fragment = "pass/temporal.frag",
                .defines = blend ? std::vector<std::pair<std::string, std::string>>{{"HISTORY_BLEND", "1"}}
                                 : std::vector<std::pair<std::string, std::string>>{}}) {}

void TemporalPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("temporal");
    inputs.brick_changed.bind(BINDING_BRICK_CHANGED);
    inputs.current.radiance.bind(BINDING_FIRST_INPUT);
    inputs.current.position.bind(BINDING_FIRST_INPUT + 1);
    inputs.current.normal.bind(BINDING_FIRST_INPUT + 2);
    inputs.current.material.bind(BINDING_FIRST_INPUT + 3);
    inputs.previous.radiance.bind(BINDING_FIRST_INPUT + 4);
    inputs.previous.position.bind(BINDING_FIRST_INPUT + 5);
    inputs.previous.normal.bind(BINDING_FIRST_INPUT + 6);
    inputs.previous.material.bind(BINDING_FIRST_INPUT + 7);
    inputs.rejected.bind_storage(0);
    program_.set("previous_version", inputs.previous_version);
    program_.use();
    outputs.history.draw_fullscreen();
}

}  // namespace tarn
