// Which parts of the world are awake and which changed, kept on the GPU: a list of bricks with a change in
// the last SLEEP_TICKS ticks, for each tick the lists of blocks that touch one of them or a neighbour, and
// the log of changes (glsl/pass/activity_*.comp, glsl/lib/activity.glsl). Owns these buffers and its
// programs; knows no rule of the water. A tick here is a step: Settings::water_substeps of them make a tick
// of the world.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "passes/changes.h"
#include "shared/water.h"

namespace tarn {

// Blocks of a tick: block k along an axis begins at k * block - offset.
struct BlockGrid {
    glm::ivec3 block_vox{1}, offset_vox{0};

    glm::ivec3 count(glm::ivec3 size_vox) const {
        return (size_vox + offset_vox + block_vox - 1) / block_vox;
    }
};

class ActivityPass {
  public:
    static constexpr int grids_max = 2;

    // All asleep; wake_all() before the first tick.
    explicit ActivityPass(glm::ivec3 size_vox);

    // As if every brick had changed in the tick before `tick`, for the sleep alone: nothing is logged.
    void wake_all(std::uint32_t tick);
    // The bricks listed (x fastest, then y, then z) changed in the tick before `tick`: wakes, stamps in
    // `brick_changed` (R32UI) and logs them.
    void touch(const std::vector<std::uint32_t>& bricks, std::uint32_t tick, std::uint32_t version,
               const gl::Texture& brick_changed);
    // All cells are new.
    void log_all() { changes_.add_all(); }
    const ChangeLog& changes() const { return changes_; }
    // Which bricks hold what moves and room for it, for lib/matter.glsl: set as they change, until it is
    // found anew.
    const gl::Buffer& matter() const { return matter_; }
    // As if no brick had changed in the ticks before `tick` for which bricks stay awake.
    void sleep_all(std::uint32_t tick);

    // Whether everything is awake in `tick`, a wake_all() before it being the last.
    bool all_awake(std::uint32_t tick) const { return woken_tick_ && tick - *woken_tick_ < SLEEP_TICKS; }
    // Finds what is awake in `tick`. At most grids_max grids.
    void begin_tick(std::uint32_t tick, std::span<const BlockGrid> grids);

    // For a program with lib/activity.glsl whose changes belong to `tick`: its uniforms and buffers of these.
    void bind(const gl::Program& program, std::uint32_t tick) const;
    // As bind(); one workgroup for each block of a grid that is awake in this tick and in which anything may
    // move as the cells are now.
    void run_blocks(const gl::Program& program, std::size_t grid, std::uint32_t tick);

    // Bricks that changed in the last SLEEP_TICKS ticks. Waits for the GPU.
    std::uint32_t active_bricks() const;
    // The same number into word `offset_bytes` of a buffer, without waiting.
    void copy_active_bricks(const gl::Buffer& to, std::size_t offset_bytes) const;
    void poll_reload(std::vector<std::string>& messages);

  private:
    const gl::Buffer& next() const { return lists_[next_]; }
    void make_room_for(std::span<const BlockGrid> grids);
    void list_blocks(std::size_t grid, std::uint32_t tick);

    glm::ivec3 size_vox_, size_bricks_;
    gl::Program wake_, blocks_program_, all_blocks_program_, touch_;
    gl::Buffer changed_tick_;
    gl::Buffer lists_[2];  // of active bricks: read in this tick, and made for the next
    int next_ = 0;
    std::array<BlockGrid, grids_max> grids_;  // of the tick
    gl::Buffer awake_blocks_[grids_max], blocks_[grids_max], block_marks_;
    std::uint32_t mark_ = 0;
    // Until SLEEP_TICKS ticks later the list of active bricks is that of all, and stays so.
    std::optional<std::uint32_t> woken_tick_;
    ChangeLog changes_;
    gl::Buffer matter_;
    std::size_t blocks_capacity_[grids_max]{};
};

}  // namespace tarn
