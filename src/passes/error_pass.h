// The estimated relMSE of a picture from the variance of its pixels, summed on the GPU and read back without
// waiting. glsl/pass/error.comp.
#pragma once
#include <glad/gl.h>

#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

class ErrorPass {
  public:
    struct Inputs {
        const gl::Texture& variance;  // r: of the luminance of the mean, VIEW_NOTHING where it is not known
        const gl::Texture& radiance;  // of the same size
    };

    ErrorPass();
    ~ErrorPass();
    ErrorPass(const ErrorPass&) = delete;
    ErrorPass& operator=(const ErrorPass&) = delete;

    bool pending() const { return fence_ != nullptr; }
    void record(const Inputs& inputs, gl::Timers& timers);  // not while pending
    // The mean over the pixels with a variance of variance / (luminance^2 + 0.01 mean(luminance)^2), once it
    // has arrived; wait: at once. Below 0 where no pixel has one.
    std::optional<double> take(bool wait);
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
