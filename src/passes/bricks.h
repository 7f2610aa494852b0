// What rays skip by (glsl/shared/rooms.h), kept up to date for changed bricks and the lines that see them
// only (glsl/pass/brick_occupancy.comp, brick_rooms.comp). Owns its programs and what lies between them.
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
        gl::Texture& brick_rooms;  // RG32UI, as in app/simulation.h; holds what the last call left
        // And which bricks hold what moves, in Inputs::activity.
    };

    explicit BricksPass(glm::ivec3 size_bricks);
    void record(const Inputs& in, const Outputs& out, gl::Timers& timers);
    // The `version` of the last call that found a changed brick. Waits for the GPU.
    std::uint32_t last_change() const { return reader_.last_change(); }
    void poll_reload(std::vector<std::string>& messages);

  private:
    ChangeReader reader_;
    gl::Program occupancy_program_;
    gl::Program rooms_program_[3];                   // by axis; run in the order y, x, z
    gl::Texture occupancy_, rooms_up_, rooms_side_;  // RG8UI, R8UI, R16UI
    gl::Buffer groups_;  // of the rooms programs, written by the occupancy program
    gl::Buffer lines_;   // of bricks, what is to be looked at; glsl/lib/room_lines.glsl
};

// ceil(size / BRICK_SIDE)
glm::ivec3 bricks_of(glm::ivec3 size_vox);

// Of the texture of words: those of full water lie behind those of air.
inline glm::ivec3 rooms_size(glm::ivec3 size_bricks) {
    return {size_bricks.x, size_bricks.y, 2 * size_bricks.z};
}

}  // namespace tarn
