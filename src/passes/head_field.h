// The head of confined water for the pressure tier (glsl/pass/head_*.comp): found by sweeps along the lines
// of the world, one axis each time it runs, and made to act once a round finds nothing new. Owns both fields
// and its programs.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "passes/activity.h"

namespace tarn {

class HeadFieldPass {
  public:
    struct Inputs {
        const gl::Texture& cells;  // R8UI
        std::uint32_t tick;        // steps of the water so far
        int film_threshold;        // quanta
        int sweeps;
        const ActivityPass& activity;  // begun for this step; nothing has changed since
    };

    // No head anywhere. Throws Error where GPU memory does not suffice: 8 bytes a voxel.
    explicit HeadFieldPass(glm::ivec3 size_vox);
    void record(const Inputs& in);
    // R32UI, size_vox; lib/head.glsl says what a head is.
    gl::Texture& acting() { return acting_; }
    void poll_reload(std::vector<std::string>& messages);

  private:
    gl::Program clock_, publish_, sweep_;
    gl::Texture acting_, building_;
    gl::Buffer clock_state_;
};

}  // namespace tarn
