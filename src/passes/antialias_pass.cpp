#include "passes/antialias_pass.h"

#include <cmath>
#include <numeric>

#include "shared/bindings.h"

namespace tarn {

namespace {

// Of the lattice in antialias.frag: without a common divisor with n + 1, so that every row is taken once, and
// near its part in the golden section, so that points lie apart. 4 gives the rotated grid.
int lattice_stride(int n) {
    constexpr double golden = 0.382;
    int best = 1;
    for (int stride = 2; stride <= n; ++stride) {
        const bool nearer = std::abs(stride - golden * (n + 1)) < std::abs(best - golden * (n + 1));
        if (nearer && std::gcd(stride, n + 1) == 1) best = stride;
    }
    return best;
}

}  // namespace

AntialiasPass::AntialiasPass()
    : program_({.label = "antialias",
                .compute = {},
                .vertex = "pass/fullscreen.vert",
                .fragment = "pass/antialias.frag",
                .defines = {}}) {}

void AntialiasPass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("antialias");
    inputs.cells.bind_image(IMAGE_CELLS, GL_READ_ONLY);
    inputs.surfaces.radiance.bind_image(IMAGE_RADIANCE, GL_READ_ONLY);
    inputs.surfaces.surface.bind_image(IMAGE_SURFACE, GL_READ_ONLY);
    // The lattices of 1, 3 and 5 lie on diagonals.
    const int n = inputs.samples + inputs.samples % 2;
    const float stride = static_cast<float>(lattice_stride(n)) / static_cast<float>(n + 1);
    program_.set("pattern", glm::vec2(n, stride));
    program_.use();
    outputs.smooth.draw_fullscreen();
}

}  // namespace tarn
