// What rays skip by: the occupancy of bricks and the distance between them, kept up to date for changed
// bricks only (glsl/pass/brick_occupancy.comp, brick_distance.comp). Owns its programs and what lies between
// them.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

class BricksPass {
  public:
    struct Inputs {
        const gl::Texture& cells;          // R8UI
        const gl::Texture& brick_changed;  // R32UI
        std::uint32_t version;             // bricks with this stamp are looked at anew
    };
    struct Outputs {
        gl::Texture& brick_distance;  // RG8UI, as in app/simulation.h; holds what the last call left
    };

    explicit BricksPass(glm::ivec3 size_bricks);
    void record(const Inputs& in, const Outputs& out, gl::Timers& timers) const;
    // The `version` of the last call that found a changed brick. Waits for the GPU.
    std::uint32_t last_change() const;
    void poll_reload(std::vector<std::string>& messages);

  private:
    gl::Program occupancy_program_;
    gl::Program distance_program_[3];  // one an axis, in the order they run
    gl::Texture occupancy_, between_;  // RG8UI
    mutable gl::Buffer last_change_;
    mutable gl::Buffer groups_;  // of the distance programs, written by the occupancy program
};

// ceil(size / BRICK_SIDE)
glm::ivec3 bricks_of(glm::ivec3 size_vox);

}  // namespace tarn
