// Smooth edges, from the surfaces that pixels show. glsl/pass/antialias.frag.
#pragma once
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/timers.h"
#include "passes/temporal_pass.h"

namespace tarn {

class AntialiasPass {
  public:
    struct Inputs {
        SurfaceBuffers surfaces;
        const gl::Texture& cells;
        int samples;  // of a pixel, 1 to 8
    };
    struct Outputs {
        const gl::Framebuffer& smooth;  // radiance, of the same size
    };

    AntialiasPass();
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    gl::Program program_;
};

}  // namespace tarn
