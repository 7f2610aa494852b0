// An estimate of the shown picture's relMSE, asked for now and then, answered some frames later: by a trial,
// a few thousand pixels against two fresh samples of exact mode each, which sees all that is wrong but not
// small errors; where that cannot tell, by the noise that the spread of the picture's frames shows. Costs
// nothing until asked for.
#pragma once
#include <deque>
#include <functional>
#include <glm/glm.hpp>
#include <optional>

#include "gl/framebuffer.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "passes/error_pass.h"
#include "passes/trial_pass.h"

namespace tarn {

// What both say together: the trial where it is above twice its own uncertainty, else the noise, but no more
// than the trial allows. Nothing where neither knows.
std::optional<double> combined_error(std::optional<double> noise, std::optional<Trial> trial);

class ErrorEstimate {
  public:
    // Trials of a picture that goes on being made alike count together, so many.
    static constexpr std::size_t trials_kept = 8;

    using Draw = std::function<void(const gl::Framebuffer&)>;
    struct Picture {
        glm::ivec2 size_px;
        Draw draw_radiance;
        Draw draw_variance = {};  // of the mean's luminance; empty: not kept
        // A sample of exact mode at a pixel in stride x stride, another one each time. Empty: no trial.
        std::function<void(const gl::Framebuffer&, int stride)> draw_sample = {};
        bool improves = false;  // from frame to frame: earlier trials say nothing
    };
    // Of the frame just made. Nothing while an earlier answer is under way.
    void measure(const Picture& picture, gl::Timers& timers);
    // Of the answers so far, the last until the next is complete; nothing before the first.
    std::optional<double> last(bool wait);
    // The picture is of another world: earlier trials count no more. The last answer stands until the next.
    void begin_anew();
    // What is known and what is under way, of a picture that is no more.
    void forget();

    template <typename Function>
    void for_each_program(Function function) {
        if (noise_pass_) noise_pass_->for_each_program(function);
        if (trial_pass_) trial_pass_->for_each_program(function);
    }

  private:
    struct Targets {
        int stride;  // of the pixels tried
        gl::Texture variance, radiance, samples[2], surface;
        gl::Framebuffer variance_target, radiance_target, sample_target[2];
        explicit Targets(glm::ivec2 size_px);
    };
    bool is_under_way() const;
    void take(bool wait);
    std::optional<double> answer() const;

    std::optional<ErrorPass> noise_pass_;
    std::optional<TrialPass> trial_pass_;
    std::optional<Targets> targets_;
    std::optional<double> noise_;
    std::deque<Trial> trials_;  // newest last
    bool improves_ = false;
    std::optional<double> answer_;
};

}  // namespace tarn
