// The world on the GPU: the cells, the structures that hang on them, the tick counter. Owns its textures and
// passes; draws nothing.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "core/settings.h"
#include "gl/buffer.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "world/edits.h"
#include "world/scene.h"

namespace tarn {

class ChangeLog;

// What springs made and drains took since the scene was loaded.
struct FlowTotals {
    std::uint64_t sprung_water_quanta = 0, drained_water_quanta = 0;
    std::uint64_t sprung_sand_voxels = 0, drained_sand_voxels = 0;
    bool operator==(const FlowTotals&) const = default;
};

class Simulation {
  public:
    // Throws Error when the world does not fit the driver's limits.
    Simulation(const Scene& scene, gl::Timers& timers);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    // n ticks, then the structures for changed bricks.
    void step(int n, const Settings& settings);

    void apply(const Edit& edit, EditHistory& history);
    void write(const std::vector<CellChange>& changes);  // undo, redo
    // Replaces the whole world's cells (size unchanged); the tick stays.
    void write_cells(const Cells& cells);

    // A cell's byte, a box's, x fastest, or a whole copy; all wait for the GPU.
    std::uint8_t read_cell(glm::ivec3 cell) const;
    std::vector<std::uint8_t> read_box(const Box& box) const;
    Cells read_cells() const;
    FlowTotals flow_totals() const;
    const EditTotals& edit_totals() const;

    // Counts of some frames ago, refreshed without waiting a few times a second of play (by `frame` calls).
    const Census& recent_census() const;
    std::uint32_t recent_active_bricks() const;
    void refresh_census(double now_s);

    glm::ivec3 size_vox() const;
    std::uint64_t tick() const;
    void set_tick(std::uint64_t tick);  // for tests of counter wrap
    // For measurements: nothing sleeps.
    void set_always_awake(bool on);
    // For measurements: all sleeps, at rest or not, until something wakes it.
    void put_to_sleep();
    // Bricks with a change in the last SLEEP_TICKS ticks: 0 when all is at rest. Waits for the GPU.
    std::uint32_t active_bricks() const;
    // Counts every step, edit or load that may have changed a cell.
    std::uint64_t version() const;
    // The version() that the last edit or load made.
    std::uint64_t last_edit() const;
    // Low 32 bits of the version() at which any cell last changed: steps of a world at rest leave it. Waits
    // for the GPU.
    std::uint32_t last_change() const;

    // R8UI, size_vox.
    const gl::Texture& cells() const;
    // RG32UI, ceil(size / BRICK_SIDE) and twice as deep: what rays skip by, glsl/shared/rooms.h; of air, then
    // of full water. Bricks cut by the world's end, and all beyond it, are never "all full water".
    const gl::Texture& brick_rooms() const;
    // R32UI, ceil(size / BRICK_SIDE): version() at which cells in it last changed (low 32 bits).
    const gl::Texture& brick_changed() const;
    // The same as a log, for what is kept up to date by differences.
    const ChangeLog& changes() const;

    // Rebuilds shaders whose files changed; returns error texts (empty string: rebuilt).
    std::vector<std::string> poll_reload();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tarn
