// Counts the cells of every byte on the GPU, anew only in tiles where some changed, and hands the counts over
// frames later, without waiting, together with how many bricks are active (glsl/pass/census*.comp). Owns its
// programs, its counters and the fence.
#pragma once
#include <glad/gl.h>

#include <optional>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "passes/activity.h"
#include "world/cells.h"

namespace tarn {

class CensusPass {
  public:
    explicit CensusPass(glm::ivec3 size_vox);
    ~CensusPass();
    CensusPass(const CensusPass&) = delete;
    CensusPass& operator=(const CensusPass&) = delete;

    bool pending() const { return fence_ != nullptr; }
    struct Counts {
        Census census;
        std::uint32_t active_bricks = 0;
    };
    struct Inputs {
        const gl::Texture& cells;  // R8UI
        const ActivityPass& activity;
        std::uint32_t version;  // of the world
    };
    // Starts a count; none is pending.
    void record(const Inputs& in, gl::Timers& timers);
    // The counts once they have arrived; ends `pending`.
    std::optional<Counts> take();
    void poll_reload(std::vector<std::string>& messages);

  private:
    ChangeReader reader_;
    gl::Program tiles_program_, count_program_;
    gl::Buffer counts_;  // of the world, always those of the last record()
    gl::Buffer stale_tiles_, tile_listed_, tile_counts_;
    gl::Buffer result_;  // counts as they were recorded, then active bricks
    GLsync fence_ = nullptr;
};

}  // namespace tarn
