// A blur against noise, or one direction of it. glsl/pass/filter.frag.
#pragma once
#include <glm/glm.hpp>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/timers.h"
#include "passes/temporal_pass.h"

namespace tarn {

class FilterPass {
  public:
    struct Inputs {
        SurfaceBuffers surfaces;
        glm::ivec2 step_px;  // between taps: (n, n); gaussian: (n, 0) or (0, n)
    };
    struct Outputs {
        const gl::Framebuffer& target;
    };

    // Gaussian: over everything, separable; otherwise within one surface. Moving: that of water may move.
    enum class Kind { Still, Moving, Gaussian };
    explicit FilterPass(Kind kind);
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    gl::Program program_;
    Kind kind_;
};

}  // namespace tarn
