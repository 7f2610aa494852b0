// One step of the `level` and `pressure` tiers of the water (glsl/pass/level_*.comp).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gl/program.h"
#include "gl/texture.h"
#include "passes/activity.h"

namespace tarn {

class LevelStepPass {
  public:
    struct Inputs {
        std::uint32_t seed, tick;  // tick: steps of the water so far
        int film_threshold;        // quanta
        std::uint32_t version;     // stamped on bricks whose cells change
        ActivityPass& activity;    // begun for this step with the grids below
    };
    struct Outputs {
        gl::Texture& cells;          // R8UI
        gl::Texture& brick_changed;  // R32UI
        gl::Texture* acting_head;    // R32UI as cells, of passes/head_field.h: the pressure tier; null: level
    };

    static std::array<BlockGrid, 2> grids(std::uint32_t seed, std::uint32_t tick);
    void record(const Inputs& in, const Outputs& out);
    void poll_reload(std::vector<std::string>& messages);

  private:
    struct Programs {
        gl::Program tall, wide;
    };
    const Programs& programs(bool pressure);

    std::optional<Programs> level_, pressure_;  // made when first needed
};

}  // namespace tarn
