// Edits: plain data {tick, shape, material}, applied to cells, kept for undo and replay. Knows no GL: it
// works on a copy of the region that an edit touches.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "world/scene.h"

namespace tarn {

enum class BrushShape { Sphere, Cube };

struct Edit {
    std::uint64_t tick = 0;
    BrushShape shape = BrushShape::Sphere;
    glm::ivec3 center_vox{0};  // a cell
    int radius_vox =
        0;  // 0: one cell. Sphere: cells with |c - center| <= radius + 0.5; cube: max norm <= radius
    std::uint8_t material = MATERIAL_AIR;  // MATERIAL_AIR removes; water is placed full
    bool overwrite = false;  // placing: false fills air and water (not sand or solids), true replaces all
    bool operator==(const Edit&) const = default;
};

// Cells that `edit` may touch, clipped to a world of `size_vox`; empty (volume 0) where it misses it.
Box bounds_of(const Edit& edit, glm::ivec3 size_vox);

// Voxels and quanta that edits added and took, by material id, air too: for each, before + placed - removed =
// after. A cell that is written over counts as removed and placed, also water over less water.
struct EditTotals {
    Census placed, removed;
    bool operator==(const EditTotals&) const = default;
};

// Adds the change of one cell's byte to `totals`; nothing where both are equal.
void count_change(std::uint8_t before, std::uint8_t after, EditTotals& totals);

// Applies `edit` to `region`, the bytes of bounds_of(edit), x fastest; adds to `totals`. Returns whether any
// changed.
bool apply_edit(const Edit& edit, const Box& bounds, std::vector<std::uint8_t>& region, EditTotals& totals);

// A cell before and after an edit, for undo. A stroke is all edits between pressing and releasing a button.
struct CellChange {
    glm::ivec3 cell;
    std::uint8_t before, after;
    bool operator==(const CellChange&) const = default;
};

// What a stroke poured and that has flowed on. `undone`: EditHistory::undo()'s; `before` and `after`: the
// bytes of `box`, which holds all its cells, around writing that. Changes that take as much water and sand
// out of `after` as the stroke placed more than the writing took: the nearest by the way that it may have
// gone, through air, water and sand, downwards at no cost; as far as there is any in the box.
std::vector<CellChange> flowed_on(const std::vector<CellChange>& undone, const Box& box,
                                  const std::vector<std::uint8_t>& before,
                                  const std::vector<std::uint8_t>& after);

// Water and sand: what flows.
struct Amounts {
    std::int64_t quanta = 0, sand = 0;  // sixteenths of a voxel of water, voxels of sand
};
Amounts amounts_of(const std::vector<std::uint8_t>& bytes);

// What the undo of a stroke took from the world.
struct Taken {
    std::vector<CellChange> elsewhere;  // than in the stroke's cells
    Amounts in_all;
};

// What redo gives back of it beyond what writing the stroke's cells again has done, `rewritten`. `after`: the
// bytes of `box`, which holds all of `taken`, after that. Where it was taken, and no more than there is room:
// what has come since stays.
std::vector<CellChange> given_back(const Taken& taken, Amounts rewritten, const Box& box,
                                   const std::vector<std::uint8_t>& after);

class EditHistory {
  public:
    // Opens a new stroke; edits recorded until the next one belong to it. Clears what could be redone.
    void begin_stroke();
    // Adds `edit` to the log and what it changed to the open stroke; `before` and `after` are the bytes of
    // `bounds`, x fastest.
    void record(const Edit& edit, const Box& bounds, const std::vector<std::uint8_t>& before,
                const std::vector<std::uint8_t>& after);
    // Changes to write (last first for undo), or nothing. The oldest strokes go once 64 MiB are kept; a
    // stroke that alone exceeds them cannot be undone. Strokes that changed nothing are not kept.
    std::optional<std::vector<CellChange>> undo();  // before/after swapped: `after` is the byte to write
    std::optional<std::vector<CellChange>> redo();
    // What the last undo() took from the world, kept for its redo().
    void took(Taken taken);
    // Of the stroke that redo() would repeat; nothing is kept then.
    Taken release_taken();
    bool can_undo() const { return !undo_.empty(); }
    bool can_redo() const { return !redo_.empty(); }
    const std::vector<Edit>& log() const { return log_; }  // every edit since the start, for replay
    void clear();

  private:
    struct Stroke {
        std::vector<CellChange> changes;
        Taken taken{};  // by its undo
        std::size_t size() const { return changes.size() + taken.elsewhere.size(); }
    };
    void clear_redo();
    void drop_beyond_cap();

    std::vector<Stroke> undo_, redo_;
    std::vector<Edit> log_;
    std::size_t kept_changes_ = 0;
    enum class Open { None, Empty, Newest, TooLong } open_ = Open::None;  // Newest: it is undo_.back()
};

}  // namespace tarn
