// Paths of one frame: radiance and the surface seen, per pixel. glsl/pass/trace.frag.
#pragma once
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

class TracePass {
  public:
    struct Inputs {
        const gl::Texture& cells;
        const gl::Texture& brick_distance;
        const gl::Texture& albedo_table;
        const gl::Buffer& rejected;  // one uint, counted up
    };
    struct Outputs {
        const gl::Framebuffer& target;  // radiance, position, normal, material
    };

    // skip: over empty bricks; otherwise voxel by voxel.
    explicit TracePass(bool skip);
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    gl::Program program_;
};

}  // namespace tarn
