// Which bricks changed, kept on the GPU: a log that the passes which change cells write through
// lib/activity.glsl, and readers that follow it, each at its own pace (glsl/pass/changes_read.comp). Knows
// nothing of what is done with them.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "gl/buffer.h"
#include "gl/program.h"
#include "shared/bindings.h"

namespace tarn {

class ChangeLog {
  public:
    // Empty; `written` entries, modulo 2^32, were written before.
    explicit ChangeLog(glm::ivec3 size_bricks, std::uint32_t written = 0);

    void bind() const { entries_.bind_storage(STORAGE_CHANGES); }
    // As if every brick had changed. Waits for the GPU.
    void add_all();
    std::uint32_t bricks() const { return bricks_; }
    // Entries that it holds: at least one for every brick of the world.
    std::uint32_t capacity() const { return capacity_; }

  private:
    std::uint32_t bricks_, capacity_;
    gl::Buffer entries_;
};

class ChangeReader {
  public:
    ChangeReader();

    // Sets aside the bricks that changed since the last call, all in the first; `version` is that of the
    // world now.
    void read(const ChangeLog& log, std::uint32_t version);
    // An invocation of `program` (lib/new_changes.glsl) for each of them.
    void run(const gl::Program& program, const ChangeLog& log) const;
    // From now on all are new again.
    void restart() { restart_ = true; }
    // The `version` of the last `read` that found a change. Waits for the GPU once after each.
    std::uint32_t last_change() const;
    std::optional<std::string> poll_reload() { return program_.poll_reload(); }

  private:
    gl::Program program_;
    gl::Buffer state_;
    std::uint32_t seen_version_ = 0;
    bool restart_ = true;
    mutable std::optional<std::uint32_t> last_change_;  // once asked for
};

}  // namespace tarn
