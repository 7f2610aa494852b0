// Exact mode's sums alone, without a scene: frames of given radiance, and sums as after any number of frames.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/timers.h"
#include "passes/accumulate_pass.h"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/trace.h"

namespace tarn {

class Accumulator {
  public:
    static constexpr int side_px = 16;
    static constexpr int pixels = side_px * side_px;
    using Values = std::array<glm::vec4, pixels>;  // a is not looked at

    Accumulator() {
        const std::uint32_t none = 0;
        rejected_.upload(std::span(&none, 1));
    }

    static gl::Texture make_texture() {
        return gl::Texture({.label = "test sums", .format = GL_RGBA32F, .size = {side_px, side_px, 0}});
    }
    static gl::Texture make_texture(const Values& values) {
        gl::Texture texture = make_texture();
        texture.upload(std::span<const glm::vec4>(values), GL_RGBA, GL_FLOAT);
        return texture;
    }

    // The sums as after `frames` frames of this mean and this variance of the luminance.
    void start_after(std::uint32_t frames, glm::dvec3 mean, double variance) {
        const glm::dvec4 sums = glm::dvec4(mean, variance) * static_cast<double>(frames);
        const glm::vec4 rounded(sums);
        fill(sets_[current_].sum, rounded);
        fill(sets_[current_].correction, glm::vec4(sums - glm::dvec4(rounded)));
        fill(sets_[current_].mean, glm::vec4(mean, 0));
        frames_ = frames;
    }
    // What the last frame left, in place of its sum.
    void write_sum(const glm::vec4& value) { fill(sets_[current_].sum, value); }

    void add(const gl::Texture& radiance) {
        FrameBlock block;
        block.counters.w = frames_;
        block_.upload(std::span(&block, 1));
        block_.bind_uniform(BINDING_FRAME);
        const Set& previous = sets_[current_];
        current_ = 1 - current_;
        pass_.record({.radiance = radiance,
                      .previous_sum = previous.sum,
                      .previous_correction = previous.correction,
                      .previous_mean = previous.mean,
                      .rejected = rejected_},
                     {.sums = sets_[current_].target}, timers_);
        timers_.end_frame();
        if (frames_ < FRAMES_KEPT_MAX) ++frames_;
    }

    std::uint32_t frames() const { return frames_; }
    Values mean() const { return read(sets_[current_].mean); }
    // Of the frames' luminance about its mean.
    double variance(int pixel) const {
        const double sum =
            double{read(sets_[current_].sum)[pixel].a} + read(sets_[current_].correction)[pixel].a;
        return sum / frames_;
    }
    std::uint32_t rejected() const {
        std::uint32_t count = 0;
        rejected_.download(std::span(&count, 1));
        return count;
    }

  private:
    struct Set {
        gl::Texture sum = make_texture(), correction = make_texture(), mean = make_texture();
        gl::Framebuffer target{"test sums", {&sum, &correction, &mean}};
    };
    static void fill(gl::Texture& texture, const glm::vec4& value) {
        Values values;
        values.fill(value);
        texture.upload(std::span<const glm::vec4>(values), GL_RGBA, GL_FLOAT);
    }
    static Values read(const gl::Texture& texture) {
        Values values;
        texture.download(std::span<glm::vec4>(values), GL_RGBA, GL_FLOAT);
        return values;
    }

    AccumulatePass pass_;
    gl::Timers timers_;
    gl::Buffer block_{"test frame block", sizeof(FrameBlock)};
    gl::Buffer rejected_{"test rejected", sizeof(std::uint32_t)};
    Set sets_[2];
    int current_ = 0;
    std::uint32_t frames_ = 0;
};

// Frames that differ and whose exact sum is known: three in turns, of another mean at every pixel.
class NoisyFrames {
  public:
    NoisyFrames() {
        for (int k = 0; k < 3; ++k) {
            for (int i = 0; i < Accumulator::pixels; ++i) values_[k][i] = glm::vec4(value(k, i), 1);
            textures_[k] = Accumulator::make_texture(values_[k]);
        }
    }

    const gl::Texture& texture(std::uint64_t frame) const { return textures_[frame % 3]; }
    glm::dvec3 value_of(std::uint64_t frame, int pixel) const { return values_[frame % 3][pixel]; }

  private:
    static glm::vec3 value(int k, int i) {
        constexpr float factors[] = {0.31f, 2.3f, 0.77f};
        return factors[k] *
               glm::vec3(0.1f + 0.01f * static_cast<float>(i), 1.7f, 13.f / static_cast<float>(i + 1));
    }
    Accumulator::Values values_[3];
    gl::Texture textures_[3];
};

}  // namespace tarn
