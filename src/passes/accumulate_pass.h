// The exact mode's mean over all frames, by compensated sums. glsl/pass/accumulate.frag.
#pragma once
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

class AccumulatePass {
  public:
    struct Inputs {
        const gl::Texture& radiance;
        const gl::Texture& previous_sum;
        const gl::Texture& previous_correction;
        const gl::Texture& previous_mean;
        const gl::Buffer& rejected;
    };
    struct Outputs {
        const gl::Framebuffer& sums;  // sum, correction, mean
    };

    AccumulatePass();
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    gl::Program program_;
};

}  // namespace tarn
