#include "app/views.h"

#include "app/stopwatch.h"

namespace tarn {

Views::Targets::Targets(const RenderTargets& targets)
    : counts({.label = "counts", .format = GL_RG32F, .size = {targets.traced_px, 0}}) {
    for (int i = 0; i < 2; ++i) {
        const FrameTargets& frame = targets.frames[i];
        moments[i] = gl::Texture({.label = "moments", .format = GL_RGBA32F, .size = {targets.kept_px(), 0}});
        trace[i] = gl::Framebuffer("trace with counts",
                                   {&targets.radiance[i], &targets.traced_surface_of(i), &counts});
        history[i] =
            targets.upsampled
                ? gl::Framebuffer("history with moments", {&frame.history, &frame.surface, &moments[i]})
                : gl::Framebuffer("history with moments", {&frame.history, &moments[i]});
    }
}

void Views::prepare(const Settings& settings, const RenderTargets& targets, bool has_history) {
    const bool kept_moments = keeps_moments_ && history_ == settings.history;
    keeps_moments_ = (settings.view == ViewKind::Variance || keep_variance_) &&
                     (settings.history == History::Blend || settings.history == History::Count);
    has_moments_ = targets_ && keeps_moments_ && kept_moments && has_history;
    view_ = settings.view;
    history_ = settings.history;
    if ((counts_paths(view_) || keeps_moments_) && !targets_) targets_.emplace(targets);
}

void Views::drop_targets() {
    targets_.reset();
}

const gl::Framebuffer& Views::trace_target(const RenderTargets& targets, int current) const {
    return counts_paths(view_) ? targets_->trace[current] : targets.trace_target[current];
}

const gl::Framebuffer& Views::history_target(const RenderTargets& targets, int current) const {
    return keeps_moments_ ? targets_->history[current] : targets.history_target[current];
}

const gl::Texture* Views::previous_moments(int current) const {
    return has_moments_ ? &targets_->moments[1 - current] : nullptr;
}

ViewPass& Views::pass(ViewKind view, History history, bool raw) {
    const auto key = std::tuple(view, history, raw);
    const auto found = passes_.find(key);
    if (found != passes_.end()) return found->second;
    const Stopwatch watch;
    ViewPass& made = passes_.try_emplace(key, view, history, raw).first->second;
    compile_ms_ += watch.ms();
    return made;
}

void Views::show(const RenderTargets& targets, int current, bool raw, const gl::Framebuffer& target,
                 gl::Timers& timers) {
    show(view_, history_, targets, current, raw, target, timers);
}

void Views::show_variance(const RenderTargets& targets, int current, const gl::Framebuffer& target,
                          gl::Timers& timers) {
    show(ViewKind::Variance, history_, targets, current, true, target, timers);
}

void Views::show_exact_variance(const RenderTargets& targets, int current, const gl::Framebuffer& target,
                                gl::Timers& timers) {
    show(ViewKind::Variance, History::Exact, targets, current, true, target, timers);
}

void Views::show(ViewKind view, History kept, const RenderTargets& targets, int current, bool raw,
                 const gl::Framebuffer& target, gl::Timers& timers) {
    const FrameTargets& frame = targets.frames[current];
    const Sums& sums = targets.sums[current];
    const gl::Texture* history = nullptr;
    const gl::Texture* moments = nullptr;
    if (kept == History::Exact) {
        history = &targets.filtered[current];
        moments = &sums.sum;
    } else if (kept != History::None) {
        history = &frame.history;
        if (targets_) moments = &targets_->moments[current];
    }
    pass(view, kept, raw)
        .record({.surface = frame.surface,
                 .counts = targets_ ? &targets_->counts : nullptr,
                 .history = history,
                 .moments = moments,
                 .correction = kept == History::Exact ? &sums.correction : nullptr},
                {.picture = target}, timers);
}

}  // namespace tarn
