// How good the shown picture is: what the renderer gives ErrorEstimate of the frame it made.
#include "app/error_estimate.h"
#include "app/frame_block.h"
#include "app/renderer_parts.h"
#include "core/error.h"
#include "shared/bindings.h"

namespace tarn {

namespace {

// From so many on the spread of exact samples tells the error of their mean; rare paths are not missed by
// then.
constexpr std::uint64_t samples_sure = 64;
// Random numbers of trials, apart from those of the picture.
constexpr std::uint32_t trial_seed = 0x9e3779b9u;

}  // namespace

// Null while its program is being built.
const TracePass* Renderer::Parts::trial_program(const Simulation& simulation) {
    // What is tried must be what was asked for.
    if (!exact_program) return nullptr;
    trial.settings = settings;
    apply_quality(trial.settings, Quality::Exact);
    trial.settings.view = ViewKind::Picture;
    trial.block = make_frame_block({.settings = trial.settings,
                                    .world_size_vox = simulation.size_vox(),
                                    .metres_per_voxel = metres_per_voxel,
                                    .seed = seed ^ trial_seed,
                                    .frame_index = 0,
                                    .frames_kept = 0,
                                    .traced_px = targets->shown_px,
                                    .shown_px = targets->shown_px});
    const Needs needs = needs_of(simulation, trial.settings, trial.block);
    return trace.find(needs.needed, needs.general, shapes(simulation));
}

void Renderer::Parts::draw_trial_sample(const Simulation& simulation, const TracePass& pass,
                                        const gl::Framebuffer& target, int stride) {
    trial.block.counters.x = trial.index++;
    frame_block.upload(std::span(&trial.block, 1));
    TracePass::Inputs inputs = trace_inputs(simulation, pass.features());
    inputs.stride = static_cast<std::uint32_t>(stride);
    pass.record(inputs, {.target = target, .timed_as = "trial"}, timers);
}

void Renderer::keep_variance(bool on) {
    parts_->views.keep_variance(on);
    if (!on) parts_->error.forget();
}

void Renderer::measure_error(const Simulation& simulation) {
    Parts& p = *parts_;
    CHECK(p.targets && p.shown != nullptr);
    // What was learned of another picture, but for where it is seen from.
    Settings as_tried = p.settings;
    as_tried.camera_position_vox = p.trial.of.camera_position_vox;
    as_tried.camera_yaw_deg = p.trial.of.camera_yaw_deg;
    as_tried.camera_pitch_deg = p.trial.of.camera_pitch_deg;
    const bool refined = p.refinement.samples > 0;
    if (difference(as_tried, p.trial.of) >= SettingEffect::IMAGE || refined != p.trial.refined)
        p.error.forget();
    else if (simulation.edit_totals() != p.trial.edits)
        p.error.begin_anew();
    p.trial.edits = simulation.edit_totals();
    p.trial.of = p.settings;
    p.trial.refined = refined;

    const bool exact = p.settings.history == History::Exact;
    ErrorEstimate::Picture picture{
        .size_px = p.targets->shown_px,
        .draw_radiance = [&](const gl::Framebuffer& to) { p.show_picture(to, true); },
        .improves = exact || refined};
    if (refined)
        picture.draw_variance = [&](const gl::Framebuffer& to) {
            p.views.show_exact_variance(*p.refinement.targets, p.refinement.current, to, p.timers);
        };
    else if (exact || p.views.keeps_moments())
        picture.draw_variance = [&](const gl::Framebuffer& to) {
            p.views.show_variance(*p.targets, p.current, to, p.timers);
        };
    FrameBlock shown = p.block;
    if (refined) shown.counters.w = p.refinement.samples - 1;
    p.frame_block.upload(std::span(&shown, 1));
    p.frame_block.bind_uniform(BINDING_FRAME);
    p.material_block.bind_uniform(BINDING_MATERIALS);
    const bool sure = (exact || refined) && samples() >= samples_sure;
    const TracePass* pass = sure ? nullptr : p.trial_program(simulation);
    if (pass != nullptr) {
        // Two samples a frame: what is estimated follows from the frame alone.
        p.trial.index = static_cast<std::uint32_t>(2 * p.frame_index);
        if (pass->features().emitters) p.update_emitters(simulation);
        picture.draw_sample = [&, pass](const gl::Framebuffer& to, int stride) {
            p.draw_trial_sample(simulation, *pass, to, stride);
        };
    }
    p.error.measure(picture, p.timers);
}

std::optional<double> Renderer::estimated_error(bool wait) const {
    return parts_->error.last(wait);
}

}  // namespace tarn
