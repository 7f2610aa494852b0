// What rays skip by: the occupancy of bricks and the distance between them, kept up to date where bricks
// changed (glsl/pass/brick_*.comp). Owns its programs and what lies between them.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "passes/activity.h"
#include "passes/changes.h"

namespace tarn {

class BricksPass {
  public:
    struct Inputs {
        const gl::Texture& cells;  // R8UI
        const ActivityPass& activity;
        std::uint32_t version;  // of the world
    };
    struct Outputs {
        gl::Texture& brick_distance;  // RG8UI, as in app/simulation.h; holds what the last call left
        // And which bricks hold what moves, in Inputs::activity.
    };

    explicit BricksPass(glm::ivec3 size_bricks);
    void record(const Inputs& in, const Outputs& out, gl::Timers& timers);
    // The `version` of the last call that found a changed brick. Waits for the GPU.
    std::uint32_t last_change() const { return reader_.last_change(); }
    void poll_reload(std::vector<std::string>& messages);

  private:
    ChangeReader reader_;
    gl::Program occupancy_program_, boxes_program_;
    gl::Program distance_program_[3];  // one an axis, in the order they run
    gl::Texture occupancy_;            // RG8UI
    gl::Texture between_[2];           // RG8UI: distances along the first axis, along the first two
    gl::Buffer flips_;                 // where occupancy changed
    gl::Buffer boxes_;                 // of the distance programs, written by the boxes program
};

// ceil(size / BRICK_SIDE)
glm::ivec3 bricks_of(glm::ivec3 size_vox);

}  // namespace tarn
