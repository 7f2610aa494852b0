// What lies under a pixel: one ray. glsl/pass/pick.comp.
#pragma once
#include <glm/glm.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

class PickPass {
  public:
    struct Inputs {
        const gl::Texture& cells;
        glm::vec3 dir;  // unit; the eye's position is the frame block's
    };
    struct Result {
        glm::ivec4 cell;    // xyz; w: 1 where something is hit
        glm::ivec4 normal;  // xyz; w: byte of the cell
    };

    // through_water: water counts as air.
    explicit PickPass(bool through_water);
    // Waits for the GPU.
    Result record(const Inputs& inputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    gl::Program program_;
    gl::Buffer result_;
};

}  // namespace tarn
