// How the world moves: the tier that steps it, what is awake, springs and drains. Owns these passes and the
// head field, which exists only while the pressure tier runs in a world that can confine water.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/settings.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "passes/activity.h"
#include "passes/block_step.h"
#include "passes/flow.h"
#include "passes/head_field.h"
#include "passes/level_step.h"
#include "world/cells.h"
#include "world/scene.h"

namespace tarn {

class Water {
  public:
    struct Inputs {
        WaterTier tier;
        int film_threshold;   // quanta
        int pressure_sweeps;  // of the head
        bool always_awake;    // nothing sleeps: for measurements
        bool springs_run, drains_run;
        std::uint32_t step;     // one more each time
        std::uint32_t version;  // stamped on bricks whose cells change
    };
    struct Outputs {
        gl::Texture& cells;          // R8UI
        gl::Texture& brick_changed;  // R32UI
    };

    // All asleep; load() first.
    explicit Water(const Scene& scene);

    // All cells are new: everything wakes and counts as changed.
    void load(const Cells& cells, std::uint32_t step);
    void wake_all(std::uint32_t step) { activity_.wake_all(step); }
    void sleep_all(std::uint32_t step) { activity_.sleep_all(step); }
    // An edit before `step` that makes `version` changed cells of `bricks`, at least one of each; `before`
    // and `after` are bytes of one box.
    struct Edited {
        const std::vector<std::uint32_t>& bricks;  // x fastest, then y, then z
        const std::vector<std::uint8_t>& before;
        const std::vector<std::uint8_t>& after;
        std::uint32_t step, version;
    };
    void edited(const Edited& edit, const gl::Texture& brick_changed);

    void step(const Inputs& in, const Outputs& out, gl::Timers& timers);

    bool flows() const { return !springs_.empty() || !drains_.empty(); }
    const FlowPass& flow() const { return flow_; }
    const ActivityPass& activity() const { return activity_; }
    std::uint32_t active_bricks() const { return activity_.active_bricks(); }
    bool has_head_field() const { return head_.has_value(); }
    void poll_reload(std::vector<std::string>& messages);

  private:
    void move_cells(const Inputs& in, const Outputs& out);

    std::uint32_t seed_;
    glm::ivec3 size_vox_;
    std::vector<Spring> springs_;
    std::vector<Drain> drains_;
    ActivityPass activity_;
    BlockStepPass block_step_;
    LevelStepPass level_step_;
    std::optional<HeadFieldPass> head_;
    FlowPass flow_;
    bool may_hold_water_ = false;
    bool may_confine_ = false;  // a solid may lie over a cell that water can reach
    std::optional<Inputs> last_;
};

}  // namespace tarn
