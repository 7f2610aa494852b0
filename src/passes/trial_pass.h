// A shown picture against fresh samples of exact mode: sums on the GPU, read back without waiting.
// glsl/pass/trial.comp.
#pragma once
#include <glad/gl.h>

#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

// The relMSE of a picture, and the variance of that figure; both of the pixels tried.
struct Trial {
    double error = 0, variance = 0;
};

class TrialPass {
  public:
    struct Inputs {
        const gl::Texture& picture;              // radiance as shown
        const gl::Texture &sample_a, &sample_b;  // independent, of exact mode
        int stride;                              // of the pixels tried, along x and y
    };

    TrialPass();
    ~TrialPass();
    TrialPass(const TrialPass&) = delete;
    TrialPass& operator=(const TrialPass&) = delete;

    bool pending() const { return fence_ != nullptr; }
    void record(const Inputs& inputs, gl::Timers& timers);  // not while pending
    // Once it has arrived; wait: at once. Nothing where no pixel was finite.
    std::optional<Trial> take(bool wait);
    void discard();  // what is under way

    template <typename Function>
    void for_each_program(Function function) {
        function(mean_);
        function(relative_);
    }

  private:
    gl::Program mean_, relative_;
    gl::Buffer sums_;
    GLsync fence_ = nullptr;
};

}  // namespace tarn
