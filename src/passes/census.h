// Counts the cells of every byte on the GPU and hands the counts over frames later, without waiting, together
// with how many bricks are active (glsl/pass/census.comp). Owns its program, its counters and the fence.
#pragma once
#include <glad/gl.h>

#include <optional>
#include <string>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "passes/activity.h"
#include "world/cells.h"

namespace tarn {

class CensusPass {
  public:
    CensusPass();
    ~CensusPass();
    CensusPass(const CensusPass&) = delete;
    CensusPass& operator=(const CensusPass&) = delete;

    bool pending() const { return fence_ != nullptr; }
    struct Counts {
        Census census;
        std::uint32_t active_bricks = 0;
    };
    // Starts a count of `cells` (R8UI); none is pending.
    void record(const gl::Texture& cells, const ActivityPass& activity, gl::Timers& timers);
    // The counts once they have arrived; ends `pending`.
    std::optional<Counts> take();
    std::optional<std::string> poll_reload() { return program_.poll_reload(); }

  private:
    gl::Program program_;
    gl::Buffer counts_;
    GLsync fence_ = nullptr;
};

}  // namespace tarn
