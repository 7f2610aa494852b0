// The `block` tier of the water on the GPU: one step, in place (glsl/pass/block_step.comp). Owns its program.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "gl/program.h"
#include "gl/texture.h"
#include "passes/activity.h"

namespace tarn {

class BlockStepPass {
  public:
    struct Inputs {
        std::uint32_t seed, tick;  // tick: steps of the water so far
        int film_threshold;        // quanta
        std::uint32_t version;     // stamped on bricks whose cells change
        ActivityPass& activity;    // begun for this step with the grid below
    };
    struct Outputs {
        gl::Texture& cells;          // R8UI
        gl::Texture& brick_changed;  // R32UI
    };

    BlockStepPass();
    static BlockGrid grid(std::uint32_t seed, std::uint32_t tick);
    // Cells are coherent for later image access and texture fetches.
    void record(const Inputs& in, const Outputs& out) const;
    std::optional<std::string> poll_reload() { return program_.poll_reload(); }

  private:
    gl::Program program_;
};

}  // namespace tarn
