#include "passes/trace_pass.h"

#include "shared/bindings.h"

namespace tarn {

TracePass::TracePass(bool skip)
    : program_({.label = skip ? "trace" : "trace voxels",
                .compute = {},
                .vertex = "pass/fullscreen.vert",
                .fragment = "pass/trace.frag",
                .defines = skip ? std::vector<std::pair<std::string, std::string>>{{"TRAVERSAL_SKIP", "1"}}
                                : std::vector<std::pair<std::string, std::string>>{}}) {}

void TracePass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("trace");
    inputs.cells.bind(BINDING_CELLS);
    inputs.brick_distance.bind(BINDING_BRICK_DISTANCE);
    inputs.albedo_table.bind(BINDING_ALBEDO_TABLE);
    inputs.rejected.bind_storage(0);
    program_.use();
    outputs.target.draw_fullscreen();
}

}  // namespace tarn
