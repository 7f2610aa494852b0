#include "app/simulation.h"

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "app/water.h"
#include "core/error.h"
#include "passes/bricks.h"
#include "passes/census.h"
#include "shared/bindings.h"

namespace tarn {

namespace {

constexpr double census_interval_s = 0.25;
// Undo moves one box while it holds at most so many voxels for each that changes.
constexpr std::uint64_t box_per_change_max = 64;

constexpr GLenum byte_layout = GL_RED_INTEGER;
constexpr GLenum byte_type = GL_UNSIGNED_BYTE;

glm::ivec3 size_within_limits(glm::ivec3 size_vox) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
    const int side = std::max({size_vox.x, size_vox.y, size_vox.z});
    if (std::min({size_vox.x, size_vox.y, size_vox.z}) < 1)
        fail("world of {}x{}x{} voxels: every side must be at least 1", size_vox.x, size_vox.y, size_vox.z);
    if (side > most)
        fail("world of {}x{}x{} voxels: this driver's 3D textures end at {} voxels a side", size_vox.x,
             size_vox.y, size_vox.z, most);
    return size_vox;
}

void add(Census& sum, const Census& more) {
    for (std::size_t id = 0; id < sum.voxels.size(); ++id) sum.voxels[id] += more.voxels[id];
    sum.water_quanta += more.water_quanta;
}

}  // namespace

struct Simulation::Parts {
    Parts(const Scene& scene, gl::Timers& frame_timers)
        : timers(frame_timers),
          size_vox(size_within_limits(scene.cells.size_vox())),
          cells({.label = "cells", .format = GL_R8UI, .size = size_vox}),
          brick_rooms({.label = "brick rooms", .format = GL_RG32UI, .size = rooms_size(bricks_of(size_vox))}),
          brick_changed({.label = "brick changed", .format = GL_R32UI, .size = bricks_of(size_vox)}),
          water(scene),
          bricks(bricks_of(size_vox)),
          census_pass(size_vox),
          census(take_census(scene.cells)) {}

    std::uint32_t stamp() const { return static_cast<std::uint32_t>(version); }
    std::uint32_t step32() const { return static_cast<std::uint32_t>(step); }
    void update_bricks() {
        bricks.record({.cells = cells, .activity = water.activity(), .version = stamp()},
                      {.brick_rooms = brick_rooms}, timers);
    }
    void load(const Cells& from);
    void mark_bricks(const Box& bounds, const std::vector<std::uint8_t>& before,
                     const std::vector<std::uint8_t>& after);
    void write_region(const Box& region, const std::vector<std::uint8_t>& before,
                      const std::vector<std::uint8_t>& after);
    std::vector<std::uint8_t> read_region(const Box& region) const;
    void write_changes(const Box& region, std::span<const CellChange* const> changes);
    void write_by_brick(std::vector<const CellChange*>& changes);  // reorders them

    gl::Timers& timers;
    glm::ivec3 size_vox;

    gl::Texture cells, brick_rooms, brick_changed;
    Water water;
    BricksPass bricks;
    CensusPass census_pass;

    std::uint64_t tick = 0;
    std::uint64_t step = 0;  // of the water: Settings::water_substeps in a tick
    bool always_awake = false;
    std::uint64_t version = 0;
    std::uint64_t last_edit = 0;  // its version
    EditTotals edit_totals;
    Census census;
    std::uint32_t recent_active_bricks = 0;
    std::uint64_t census_version = 0;  // of `census`, or of the count under way
    double census_time_s = -1e300;
};

void Simulation::Parts::load(const Cells& from) {
    last_edit = ++version;
    cells.upload(std::span<const std::uint8_t>(from.bytes()), byte_layout, byte_type);
    const std::uint32_t all = stamp();
    glClearTexImage(brick_changed.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &all);
    water.load(from, step32());
    update_bricks();
}

std::vector<std::uint8_t> Simulation::Parts::read_region(const Box& region) const {
    std::vector<std::uint8_t> bytes(region.volume());
    cells.download(region.min_vox, region.size(), std::span<std::uint8_t>(bytes), byte_layout, byte_type);
    return bytes;
}

void Simulation::Parts::mark_bricks(const Box& bounds, const std::vector<std::uint8_t>& before,
                                    const std::vector<std::uint8_t>& after) {
    const glm::ivec3 first = bounds.min_vox / BRICK_SIDE;
    const glm::ivec3 size = (bounds.max_vox - 1) / BRICK_SIDE - first + 1;
    const glm::ivec3 all = brick_changed.size();
    std::vector<char> marked(std::size_t{1} * size.x * size.y * size.z, 0);
    std::vector<std::uint32_t> touched;
    std::size_t i = 0;
    for (int z = bounds.min_vox.z; z < bounds.max_vox.z; ++z)
        for (int y = bounds.min_vox.y; y < bounds.max_vox.y; ++y)
            for (int x = bounds.min_vox.x; x < bounds.max_vox.x; ++x, ++i) {
                if (before[i] == after[i]) continue;
                const glm::ivec3 brick = glm::ivec3(x, y, z) / BRICK_SIDE;
                const glm::ivec3 at = brick - first;
                char& mark = marked[at.x + std::size_t{1} * size.x * (at.y + std::size_t{1} * size.y * at.z)];
                if (mark != 0) continue;
                mark = 1;
                touched.push_back(static_cast<std::uint32_t>(brick.x + all.x * (brick.y + all.y * brick.z)));
            }
    last_edit = version;
    water.edited({.bricks = touched, .before = before, .after = after, .step = step32(), .version = stamp()},
                 brick_changed);
}

void Simulation::Parts::write_region(const Box& region, const std::vector<std::uint8_t>& before,
                                     const std::vector<std::uint8_t>& after) {
    cells.upload(region.min_vox, region.size(), std::span<const std::uint8_t>(after), byte_layout, byte_type);
    mark_bricks(region, before, after);
}

Simulation::Simulation(const Scene& scene, gl::Timers& timers)
    : parts_(std::make_unique<Parts>(scene, timers)) {
    parts_->load(scene.cells);
    parts_->census_version = parts_->version;
}

Simulation::~Simulation() = default;

void Simulation::step(int n, const Settings& settings) {
    if (n <= 0) return;
    Parts& p = *parts_;
    ++p.version;
    {
        // Nothing between the ticks: one pair of time stamps for many.
        std::optional<gl::Timers::Scope> scope;
        if (!p.water.flows()) scope.emplace(p.timers, "step");
        for (int i = 0; i < n; ++i, ++p.tick)
            for (int k = 0; k < settings.water_substeps; ++k, ++p.step)
                p.water.step({.tier = settings.water_tier,
                              .film_threshold = settings.film_threshold,
                              .pressure_sweeps = settings.pressure_sweeps,
                              .always_awake = p.always_awake,
                              .springs_run = k == 0,
                              .drains_run = k + 1 == settings.water_substeps,
                              .step = p.step32(),
                              .version = p.stamp()},
                             {.cells = p.cells, .brick_changed = p.brick_changed}, p.timers);
    }
    p.update_bricks();
}

void Simulation::apply(const Edit& edit, EditHistory& history) {
    Parts& p = *parts_;
    const Box bounds = bounds_of(edit, p.size_vox);
    if (bounds.volume() == 0) return;
    const std::vector<std::uint8_t> before = p.read_region(bounds);
    std::vector<std::uint8_t> after = before;
    if (!apply_edit(edit, bounds, after, p.edit_totals)) return;
    ++p.version;
    p.write_region(bounds, before, after);
    p.update_bricks();
    history.record(edit, bounds, before, after);
}

void Simulation::write(const std::vector<CellChange>& changes) {
    if (changes.empty()) return;
    Parts& p = *parts_;
    ++p.version;
    Box box{p.size_vox, glm::ivec3(0)};
    for (const CellChange& change : changes) {
        box.min_vox = glm::min(box.min_vox, change.cell);
        box.max_vox = glm::max(box.max_vox, change.cell + 1);
    }
    CHECK(glm::all(glm::greaterThanEqual(box.min_vox, glm::ivec3(0))) &&
          glm::all(glm::lessThanEqual(box.max_vox, p.size_vox)));
    std::vector<const CellChange*> in_order;
    in_order.reserve(changes.size());
    for (const CellChange& change : changes) in_order.push_back(&change);
    if (box.volume() <= box_per_change_max * changes.size()) {
        p.write_changes(box, in_order);
    } else {
        p.write_by_brick(in_order);
    }
    p.update_bricks();
}

void Simulation::Parts::write_changes(const Box& region, std::span<const CellChange* const> changes) {
    const std::vector<std::uint8_t> before = read_region(region);
    std::vector<std::uint8_t> after = before;
    const glm::ivec3 size = region.size();
    for (const CellChange* change : changes) {
        const glm::ivec3 at = change->cell - region.min_vox;
        after[at.x + std::size_t{1} * size.x * (at.y + std::size_t{1} * size.y * at.z)] = change->after;
    }
    for (std::size_t k = 0; k < after.size(); ++k) count_change(before[k], after[k], edit_totals);
    if (after != before) write_region(region, before, after);
}

// A stroke may cross the whole world. The order within a brick is kept.
void Simulation::Parts::write_by_brick(std::vector<const CellChange*>& changes) {
    const auto brick_of = [](const CellChange* change) { return change->cell / BRICK_SIDE; };
    std::stable_sort(changes.begin(), changes.end(), [&](const CellChange* a, const CellChange* b) {
        const glm::ivec3 left = brick_of(a);
        const glm::ivec3 right = brick_of(b);
        return std::tie(left.z, left.y, left.x) < std::tie(right.z, right.y, right.x);
    });
    for (auto first = changes.begin(); first != changes.end();) {
        const glm::ivec3 brick = brick_of(*first);
        const auto last = std::find_if(first, changes.end(), [&](auto* c) { return brick_of(c) != brick; });
        const Box region{brick * BRICK_SIDE, glm::min((brick + 1) * BRICK_SIDE, size_vox)};
        write_changes(region, {first, last});
        first = last;
    }
}

void Simulation::write_cells(const Cells& cells) {
    Parts& p = *parts_;
    CHECK(cells.size_vox() == p.size_vox);
    const Census before = take_census(read_cells());
    p.load(cells);
    p.census = take_census(cells);
    p.census_version = p.version;
    add(p.edit_totals.removed, before);
    add(p.edit_totals.placed, p.census);
}

std::uint8_t Simulation::read_cell(glm::ivec3 cell) const {
    CHECK(glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) && glm::all(glm::lessThan(cell, size_vox())));
    return parts_->read_region({cell, cell + 1})[0];
}

std::vector<std::uint8_t> Simulation::read_box(const Box& box) const {
    return parts_->read_region(box);
}

Cells Simulation::read_cells() const {
    Cells cells(size_vox());
    parts_->cells.download(std::span<std::uint8_t>(cells.bytes()), byte_layout, byte_type);
    return cells;
}

FlowTotals Simulation::flow_totals() const {
    const FlowPass::Counts counts = parts_->water.flow().counts();
    return {counts.sprung_water_quanta, counts.drained_water_quanta, counts.sprung_sand_voxels,
            counts.drained_sand_voxels};
}

const EditTotals& Simulation::edit_totals() const {
    return parts_->edit_totals;
}

const Census& Simulation::recent_census() const {
    return parts_->census;
}

std::uint32_t Simulation::recent_active_bricks() const {
    return parts_->recent_active_bricks;
}

void Simulation::refresh_census(double now_s) {
    Parts& p = *parts_;
    if (const auto arrived = p.census_pass.take()) {
        p.census = arrived->census;
        p.recent_active_bricks = arrived->active_bricks;
    }
    if (p.census_pass.pending() || p.census_version == p.version) return;
    if (now_s >= p.census_time_s && now_s - p.census_time_s < census_interval_s) return;
    p.census_pass.record({.cells = p.cells, .activity = p.water.activity(), .version = p.stamp()}, p.timers);
    p.census_version = p.version;
    p.census_time_s = now_s;
}

glm::ivec3 Simulation::size_vox() const {
    return parts_->size_vox;
}
std::uint64_t Simulation::tick() const {
    return parts_->tick;
}
void Simulation::set_tick(std::uint64_t tick) {
    parts_->tick = tick;
    parts_->step = tick;
    parts_->water.wake_all(parts_->step32());
}
void Simulation::set_always_awake(bool on) {
    parts_->always_awake = on;
}
void Simulation::put_to_sleep() {
    parts_->water.sleep_all(parts_->step32());
}
std::uint32_t Simulation::active_bricks() const {
    return parts_->water.active_bricks();
}
std::uint32_t Simulation::last_change() const {
    return parts_->bricks.last_change();
}

std::uint64_t Simulation::version() const {
    return parts_->version;
}
std::uint64_t Simulation::last_edit() const {
    return parts_->last_edit;
}
const gl::Texture& Simulation::cells() const {
    return parts_->cells;
}
const gl::Texture& Simulation::brick_rooms() const {
    return parts_->brick_rooms;
}
const gl::Texture& Simulation::brick_changed() const {
    return parts_->brick_changed;
}
const ChangeLog& Simulation::changes() const {
    return parts_->water.activity().changes();
}

std::vector<std::string> Simulation::poll_reload() {
    std::vector<std::string> messages;
    parts_->water.poll_reload(messages);
    parts_->bricks.poll_reload(messages);
    parts_->census_pass.poll_reload(messages);
    return messages;
}

}  // namespace tarn
