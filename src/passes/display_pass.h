// From radiance to the picture. glsl/pass/display.frag.
#pragma once
#include <cstdint>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

class DisplayPass {
  public:
    struct Inputs {
        const gl::Texture& radiance;  // RGBA32F, of any size
        // Refined: exact mode's mean, its sums, how many samples they are; of the target's size.
        const gl::Texture* exact_mean = nullptr;
        const gl::Texture* exact_sum = nullptr;
        std::uint32_t exact_samples = 0;
    };
    struct Outputs {
        const gl::Framebuffer& picture;
    };

    // radiance_only: the target keeps linear radiance at the shown size; otherwise tone-mapped sRGB. refined:
    // an exact mean is mixed in.
    DisplayPass(bool radiance_only, bool refined);
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    bool refined_;
    gl::Program program_;
};

}  // namespace tarn
