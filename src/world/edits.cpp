#include "world/edits.h"

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace tarn {

namespace {

constexpr std::size_t history_bytes_max = std::size_t{64} << 20;
constexpr std::size_t history_changes_max = history_bytes_max / sizeof(CellChange);

bool inside(const Edit& edit, glm::ivec3 cell) {
    if (edit.shape == BrushShape::Cube) return true;  // its bounds are the cube
    // |d| <= r + 1/2 in whole numbers: d.d <= r^2 + r. Each |d| <= r < 2^31, so the sum fits unsigned.
    std::uint64_t squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t d = std::int64_t{cell[axis]} - edit.center_vox[axis];
        squared += static_cast<std::uint64_t>(d * d);
    }
    const auto r = static_cast<std::uint64_t>(edit.radius_vox);
    return squared <= r * r + r;
}

bool replaces(const Edit& edit, std::uint8_t byte) {
    return edit.material == MATERIAL_AIR || edit.overwrite || byte == MATERIAL_AIR || is_water(byte);
}

std::uint8_t byte_of(const Edit& edit) {
    return is_water(edit.material) ? static_cast<std::uint8_t>(MATERIAL_WATER_FULL) : edit.material;
}

void add_cell(std::uint8_t byte, Census& census) {
    ++census.voxels[material_of(byte)];
    census.water_quanta += quanta_of(byte);
}

// Calls f(cell, index) for the cells of `bounds`, x fastest.
template <typename F>
void for_each_cell(const Box& bounds, F&& f) {
    std::size_t index = 0;
    for (int z = bounds.min_vox.z; z < bounds.max_vox.z; ++z) {
        for (int y = bounds.min_vox.y; y < bounds.max_vox.y; ++y) {
            for (int x = bounds.min_vox.x; x < bounds.max_vox.x; ++x) f(glm::ivec3(x, y, z), index++);
        }
    }
}

}  // namespace

Box bounds_of(const Edit& edit, glm::ivec3 size_vox) {
    CHECK(edit.radius_vox >= 0);
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t center = edit.center_vox[axis];
        const std::int64_t min = std::max<std::int64_t>(center - edit.radius_vox, 0);
        const std::int64_t max = std::min<std::int64_t>(center + edit.radius_vox + 1, size_vox[axis]);
        if (min >= max) return {};
        box.min_vox[axis] = static_cast<int>(min);
        box.max_vox[axis] = static_cast<int>(max);
    }
    return box;
}

void count_change(std::uint8_t before, std::uint8_t after, EditTotals& totals) {
    if (before == after) return;
    add_cell(before, totals.removed);
    add_cell(after, totals.placed);
}

bool apply_edit(const Edit& edit, const Box& bounds, std::vector<std::uint8_t>& region, EditTotals& totals) {
    CHECK(region.size() == bounds.volume());
    const std::uint8_t written = byte_of(edit);
    bool changed = false;
    for_each_cell(bounds, [&](glm::ivec3 cell, std::size_t index) {
        std::uint8_t& byte = region[index];
        if (byte == written || !replaces(edit, byte) || !inside(edit, cell)) return;
        count_change(byte, written, totals);
        byte = written;
        changed = true;
    });
    return changed;
}

void EditHistory::begin_stroke() {
    clear_redo();
    open_ = Open::Empty;
}

void EditHistory::record(const Edit& edit, const Box& bounds, const std::vector<std::uint8_t>& before,
                         const std::vector<std::uint8_t>& after) {
    CHECK(before.size() == bounds.volume() && after.size() == bounds.volume());
    log_.push_back(edit);
    clear_redo();
    if (open_ == Open::TooLong) return;
    std::vector<CellChange> changes;
    for_each_cell(bounds, [&](glm::ivec3 cell, std::size_t index) {
        if (before[index] != after[index]) changes.push_back({cell, before[index], after[index]});
    });
    if (changes.empty()) return;
    kept_changes_ += changes.size();
    if (open_ == Open::Newest)
        undo_.back().changes.insert(undo_.back().changes.end(), changes.begin(), changes.end());
    else
        undo_.push_back({std::move(changes)});
    open_ = Open::Newest;
    drop_beyond_cap();
}

std::optional<std::vector<CellChange>> EditHistory::undo() {
    if (undo_.empty()) return std::nullopt;
    open_ = Open::None;
    std::vector<CellChange> changes = undo_.back().changes;
    redo_.push_back(std::move(undo_.back()));
    undo_.pop_back();
    std::reverse(changes.begin(), changes.end());
    for (CellChange& change : changes) std::swap(change.before, change.after);
    return changes;
}

std::optional<std::vector<CellChange>> EditHistory::redo() {
    if (redo_.empty()) return std::nullopt;
    open_ = Open::None;
    release_taken();
    std::vector<CellChange> changes = redo_.back().changes;
    undo_.push_back(std::move(redo_.back()));
    redo_.pop_back();
    return changes;
}

void EditHistory::took(Taken taken) {
    CHECK(!redo_.empty());
    release_taken();
    kept_changes_ += taken.elsewhere.size();
    redo_.back().taken = std::move(taken);
}

Taken EditHistory::release_taken() {
    if (redo_.empty()) return {};
    kept_changes_ -= redo_.back().taken.elsewhere.size();
    return std::exchange(redo_.back().taken, {});
}

void EditHistory::clear() {
    *this = EditHistory();
}

void EditHistory::clear_redo() {
    for (const Stroke& stroke : redo_) kept_changes_ -= stroke.size();
    redo_.clear();
}

void EditHistory::drop_beyond_cap() {
    while (kept_changes_ > history_changes_max) {
        if (undo_.size() == 1) open_ = Open::TooLong;
        kept_changes_ -= undo_.front().size();
        undo_.erase(undo_.begin());
    }
}

}  // namespace tarn
