// Springs and drains on the GPU (glsl/pass/flow.comp). Owns its programs and the counters of what they made
// and took.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "passes/activity.h"
#include "world/scene.h"

namespace tarn {

class FlowPass {
  public:
    struct Inputs {
        std::uint32_t seed, tick;      // tick: steps of the water so far
        std::uint32_t version;         // stamped on bricks whose cells change
        const ActivityPass& activity;  // begun for this step
    };
    struct Outputs {
        gl::Texture& cells;          // R8UI
        gl::Texture& brick_changed;  // R32UI
    };
    struct Counts {
        std::uint64_t sprung_water_quanta, drained_water_quanta, sprung_sand_voxels, drained_sand_voxels;
        bool operator==(const Counts&) const = default;
    };

    FlowPass() : FlowPass(Counts{}) {}
    explicit FlowPass(const Counts& start);
    // One after the other, in the order of the list. Regions are clipped to the world.
    void record_springs(const std::vector<Spring>& springs, const Inputs& in, const Outputs& out) const;
    void record_drains(const std::vector<Drain>& drains, const Inputs& in, const Outputs& out) const;
    // Since the start. Waits for the GPU.
    Counts counts() const;
    void poll_reload(std::vector<std::string>& messages);

  private:
    void dispatch(const gl::Program& program, const Box& region, const Inputs& in, const Outputs& out) const;

    gl::Program spring_, drain_;
    gl::Buffer counters_;
};

}  // namespace tarn
