#include "app/water.h"

#include <algorithm>

namespace tarn {

namespace {

// What no rule moves.
bool is_fixed(std::uint8_t byte) {
    return byte != MATERIAL_AIR && byte != MATERIAL_SAND && !is_water(byte);
}

bool has_overhang(const Cells& cells) {
    const glm::ivec3 size = cells.size_vox();
    for (int z = 0; z < size.z; ++z)
        for (int y = 1; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (is_fixed(cells.at({x, y, z})) && !is_fixed(cells.at({x, y - 1, z}))) return true;
    return false;
}

bool holds_water(const std::vector<std::uint8_t>& bytes) {
    return std::any_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return is_water(byte); });
}

}  // namespace

Water::Water(const Scene& scene)
    : seed_(scene.seed),
      size_vox_(scene.cells.size_vox()),
      springs_(scene.springs),
      drains_(scene.drains),
      activity_(size_vox_) {}

void Water::load(const Cells& cells, std::uint32_t step) {
    may_hold_water_ = holds_water(cells.bytes()) ||
                      std::any_of(springs_.begin(), springs_.end(),
                                  [](const Spring& s) { return s.material == MATERIAL_WATER; });
    may_confine_ = has_overhang(cells);
    head_.reset();
    activity_.wake_all(step);
    activity_.log_all();
}

void Water::edited(const Edited& edit, const gl::Texture& brick_changed) {
    may_hold_water_ = may_hold_water_ || holds_water(edit.after);
    for (std::size_t i = 0; i < edit.after.size() && !may_confine_; ++i)
        may_confine_ = is_fixed(edit.before[i]) != is_fixed(edit.after[i]);
    activity_.touch(edit.bricks, edit.step, edit.version, brick_changed);
}

void Water::step(const Inputs& in, const Outputs& out, gl::Timers& timers) {
    // What was at rest under one rule need not be under another.
    const bool other_rule = last_ && (last_->tier != in.tier || last_->film_threshold != in.film_threshold);
    if (other_rule || (in.always_awake && !activity_.all_awake(in.step))) activity_.wake_all(in.step);
    last_ = in;
    if (in.tier != WaterTier::Pressure) head_.reset();
    if (in.tier == WaterTier::Pressure && !head_ && may_hold_water_ && may_confine_) head_.emplace(size_vox_);

    if (in.tier == WaterTier::Block) {
        activity_.begin_tick(in.step, {{BlockStepPass::grid(seed_, in.step)}});
    } else {
        activity_.begin_tick(in.step, LevelStepPass::grids(seed_, in.step));
    }
    if (head_) {
        std::optional<gl::Timers::Scope> scope;
        if (flows()) scope.emplace(timers, "head");
        head_->record({.cells = out.cells,
                       .tick = in.step,
                       .film_threshold = in.film_threshold,
                       .sweeps = in.pressure_sweeps,
                       .activity = activity_});
    }
    const FlowPass::Inputs flow_in{
        .seed = seed_, .tick = in.step, .version = in.version, .activity = activity_};
    const FlowPass::Outputs flow_out{.cells = out.cells, .brick_changed = out.brick_changed};
    if (!springs_.empty() && in.springs_run) {
        const auto scope = timers.scope("flow");
        flow_.record_springs(springs_, flow_in, flow_out);
    }
    {
        std::optional<gl::Timers::Scope> scope;
        if (flows()) scope.emplace(timers, "step");
        move_cells(in, out);
    }
    if (!drains_.empty() && in.drains_run) {
        const auto scope = timers.scope("flow");
        flow_.record_drains(drains_, flow_in, flow_out);
    }
}

void Water::move_cells(const Inputs& in, const Outputs& out) {
    if (in.tier == WaterTier::Block) {
        block_step_.record({.seed = seed_,
                            .tick = in.step,
                            .film_threshold = in.film_threshold,
                            .version = in.version,
                            .activity = activity_},
                           {.cells = out.cells, .brick_changed = out.brick_changed});
        return;
    }
    level_step_.record({.seed = seed_,
                        .tick = in.step,
                        .film_threshold = in.film_threshold,
                        .version = in.version,
                        .activity = activity_},
                       {.cells = out.cells,
                        .brick_changed = out.brick_changed,
                        .acting_head = head_ ? &head_->acting() : nullptr});
}

void Water::poll_reload(std::vector<std::string>& messages) {
    if (auto message = block_step_.poll_reload()) messages.push_back(*message);
    activity_.poll_reload(messages);
    level_step_.poll_reload(messages);
    if (head_) head_->poll_reload(messages);
    flow_.poll_reload(messages);
}

}  // namespace tarn
