// Reverse reprojection of earlier frames. glsl/pass/temporal.frag.
#pragma once
#include <cstdint>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

// What a frame holds of each pixel: light, and what shows it (glsl/lib/surface.glsl).
struct SurfaceBuffers {
    const gl::Texture& radiance;
    const gl::Texture& surface;
};

class TemporalPass {
  public:
    struct Inputs {
        SurfaceBuffers current;   // as traced
        SurfaceBuffers previous;  // radiance: history, alpha: frames kept
        const gl::Texture& cells;
        const gl::Texture& brick_changed;
        std::uint32_t new_pixel_samples = 1;  // as the trace pass had it
        std::uint32_t previous_version;       // of the world, when the previous frame was made
        const gl::Buffer& rejected;
        // The previous frame's light as traced, and some of its paths in this world; null where none was
        // traced again. Not with blend.
        const gl::Texture* traced_before = nullptr;
        const gl::Texture* retraced = nullptr;          // of one traced pixel in stride^2
        int retrace_stride = 0;                         // 0: none was
        const gl::Texture* previous_moments = nullptr;  // with moments; null where the last frame kept none
    };
    struct Outputs {
        const gl::Framebuffer& history;  // history; upsample: surface; with moments: moments
    };

    // blend: constant weight; otherwise a running mean. moments: what the variance of the mean follows from,
    // too.
    // upsample: of fewer pixels than history has.
    TemporalPass(bool blend, bool moments, bool upsample);
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    bool blend_, moments_, upsample_;
    gl::Program program_;
};

}  // namespace tarn
