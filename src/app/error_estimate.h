// An estimate of the shown picture's relMSE, asked for now and then: pictures of variance and radiance, their
// sums, the answer some frames later. Costs nothing until asked for.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <optional>

#include "gl/framebuffer.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "passes/error_pass.h"

namespace tarn {

class ErrorEstimate {
  public:
    using Draw = std::function<void(const gl::Framebuffer&)>;
    // Of the frame just made. Nothing while an earlier answer is under way.
    void measure(glm::ivec2 size_px, const Draw& draw_variance, const Draw& draw_radiance,
                 gl::Timers& timers);
    // The last answer; nothing before the first, or where nothing is known of the variance.
    std::optional<double> last(bool wait);
    void forget() { last_.reset(); }

    template <typename Function>
    void for_each_program(Function function) {
        if (pass_) pass_->for_each_program(function);
    }

  private:
    struct Targets {
        gl::Texture variance, radiance;
        gl::Framebuffer variance_target, radiance_target;
        explicit Targets(glm::ivec2 size_px);
    };
    std::optional<ErrorPass> pass_;
    std::optional<Targets> targets_;
    std::optional<double> last_;
};

}  // namespace tarn
