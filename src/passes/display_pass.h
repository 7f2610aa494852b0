// From radiance to the picture. glsl/pass/display.frag.
#pragma once
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

class DisplayPass {
  public:
    struct Inputs {
        const gl::Texture& radiance;  // linear filtering where its size differs from the target's
    };
    struct Outputs {
        const gl::Framebuffer& picture;
    };

    // radiance_only: the target keeps linear radiance at the shown size; otherwise tone-mapped sRGB.
    explicit DisplayPass(bool radiance_only);
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    gl::Program program_;
};

}  // namespace tarn
