#include "passes/accumulate_pass.h"

namespace tarn {

AccumulatePass::AccumulatePass()
    : program_({.label = "accumulate",
                .compute = {},
                .vertex = "pass/fullscreen.vert",
                .fragment = "pass/accumulate.frag",
                .defines = {}}) {}

void AccumulatePass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("accumulate");
    inputs.radiance.bind(0);
    inputs.previous_sum.bind(1);
    inputs.previous_correction.bind(2);
    inputs.previous_mean.bind(3);
    inputs.rejected.bind_storage(0);
    program_.use();
    outputs.sums.draw_fullscreen();
}

}  // namespace tarn
