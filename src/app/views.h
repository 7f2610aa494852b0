// The views of what the renderer knows besides radiance: their targets and programs, each made when it is
// first asked for, so that pictures cost nothing more.
#pragma once
#include <map>
#include <optional>
#include <tuple>

#include "app/render_targets.h"
#include "core/settings.h"
#include "passes/view_pass.h"

namespace tarn {

// True for views that need a trace pass which counts.
constexpr bool counts_paths(ViewKind view) {
    return view == ViewKind::Bounces || view == ViewKind::Steps;
}

class Views {
  public:
    // Before the passes of a frame with these settings; has_history: the last frame's history goes on.
    void prepare(const Settings& settings, const RenderTargets& targets, bool has_history);
    // Whenever the picture's targets are made anew.
    void drop_targets();

    // From the next prepare() on: what the variance follows from is kept, whatever is shown.
    void keep_variance(bool on) { keep_variance_ = on; }
    bool keeps_moments() const { return keeps_moments_; }

    // What the passes write to and read from; the picture's own targets where the view needs no more.
    // `current` as in the renderer.
    const gl::Framebuffer& trace_target(const RenderTargets& targets, int current) const;
    const gl::Framebuffer& history_target(const RenderTargets& targets, int current) const;
    const gl::Texture* previous_moments(int current) const;  // null where the last frame kept none

    // Draws the view of the frame that the passes just made; raw: its values, else sRGB.
    void show(const RenderTargets& targets, int current, bool raw, const gl::Framebuffer& target,
              gl::Timers& timers);
    // The raw view of the variance, of a frame that kept it.
    void show_variance(const RenderTargets& targets, int current, const gl::Framebuffer& target,
                       gl::Timers& timers);
    // Likewise of an exact mean's own targets, beside which the picture's may be of another history.
    void show_exact_variance(const RenderTargets& targets, int current, const gl::Framebuffer& target,
                             gl::Timers& timers);

    double compile_ms() const { return compile_ms_; }
    template <typename Function>
    void for_each_program(Function function) {
        for (auto& [key, pass] : passes_) function(pass.program());
    }

  private:
    struct Targets {
        gl::Texture counts;      // bounces, steps
        gl::Texture moments[2];  // current and previous
        gl::Framebuffer trace[2], history[2];
        explicit Targets(const RenderTargets& targets);
    };
    ViewPass& pass(ViewKind view, History history, bool raw);
    void show(ViewKind view, History history, const RenderTargets& targets, int current, bool raw,
              const gl::Framebuffer& target, gl::Timers& timers);

    std::optional<Targets> targets_;
    std::map<std::tuple<ViewKind, History, bool>, ViewPass> passes_;  // [view, history, raw]
    ViewKind view_ = ViewKind::Picture;
    History history_ = History::None;
    bool keep_variance_ = false;
    bool keeps_moments_ = false;  // this frame writes some
    bool has_moments_ = false;    // the last frame wrote some
    double compile_ms_ = 0;
};

}  // namespace tarn
