// A picture at rest: frames of exact mode are added up beside what the preset made last, and shown with as
// much weight as they have earned.
#include <algorithm>

#include "app/frame_block.h"
#include "app/renderer_parts.h"
#include "shared/bindings.h"

namespace tarn {

namespace {

// The preset's own history comes first: later frames would add little to it.
constexpr std::uint32_t preset_frames = 48;
// Exact frames take several times as long as the presets'.
constexpr int bands = 4;

}  // namespace

bool same_eye(const Settings& a, const Settings& b) {
    return a.camera_position_vox == b.camera_position_vox && a.camera_yaw_deg == b.camera_yaw_deg &&
           a.camera_pitch_deg == b.camera_pitch_deg && a.camera_fov_deg == b.camera_fov_deg;
}

bool Renderer::Parts::is_at_rest(const Simulation& simulation, const Settings& now, glm::ivec2 size_px) {
    Refinement& r = refinement;
    const bool averages = now.history == History::Count || now.history == History::Blend;
    bool rests = now.refine_at_rest && averages && now.view == ViewKind::Picture && has_history && targets &&
                 targets->shown_px == size_px && same_eye(now, settings) &&
                 difference(now, settings) < SettingEffect::IMAGE;
    rests = rests && !world_changed(simulation);
    r.frames_at_rest = rests ? r.frames_at_rest + 1 : 0;
    const auto cap = static_cast<std::uint32_t>(now.history_cap);
    const bool ready =
        r.frames_at_rest >= (now.history == History::Count ? std::min(preset_frames, cap) : preset_frames);
    if (!ready) {
        r.targets.reset();
        r.samples = 0;
        r.band = 0;
    }
    return ready;
}

void Renderer::Parts::refine(const Simulation& simulation, const Settings& now) {
    Refinement& r = refinement;
    settings = now;
    r.settings = now;
    apply_quality(r.settings, Quality::Exact);
    if (!r.targets) r.targets.emplace(targets->shown_px, targets->shown_px, true, false);
    r.block = make_frame_block({.settings = r.settings,
                                .world_size_vox = simulation.size_vox(),
                                .metres_per_voxel = metres_per_voxel,
                                .seed = seed,
                                .frame_index = static_cast<std::uint32_t>(frame_index),
                                .frames_kept = r.samples,
                                .traced_px = targets->shown_px,
                                .shown_px = targets->shown_px});
    block.display = r.block.display;
    frame_block.upload(std::span(&r.block, 1));
    frame_block.bind_uniform(BINDING_FRAME);
    material_block.bind_uniform(BINDING_MATERIALS);

    const TracePrograms::Choice choice = program_for(simulation, r.settings, r.block);
    if (!choice.exact) return;  // its program is being built
    const TraceFeatures& needed = choice.pass.features();
    if (needed.emitters) update_emitters(simulation);
    const glm::ivec2 size = targets->shown_px;
    const int first_row = size.y * r.band / bands;
    const gl::Rows rows{first_row, size.y * (r.band + 1) / bands - first_row};
    choice.pass.record(trace_inputs(simulation, needed), {.target = r.targets->trace_target[0], .rows = rows},
                       timers);
    r.band = (r.band + 1) % bands;
    if (r.band != 0) return;
    r.current = 1 - r.current;
    built(accumulate)
        .record({.radiance = r.targets->radiance[0],
                 .previous_sum = r.targets->sums[1 - r.current].sum,
                 .previous_correction = r.targets->sums[1 - r.current].correction,
                 .previous_mean = r.targets->filtered[1 - r.current],
                 .rejected = rejected},
                {.sums = r.targets->sums_target[r.current]}, timers);
    r.samples = std::min(r.samples + 1, FRAMES_KEPT_MAX);
}

}  // namespace tarn
