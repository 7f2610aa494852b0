// Extremes of time: a million frames of history, counters at 2^32 - 1, what is not finite written into
// history on purpose. The tick counter's wrap is in water_test, sleep_test and flow_test; times of 0 and 10 s
// in the unit tests of the tick clock (tick_clock_test), the camera (camera_test) and, with the picture, in
// app_test.
#include <cmath>
#include <limits>

#include "accumulator.h"
#include "shared/trace.h"
#include "studio.h"

namespace tarn {
namespace {

class ExtremesHistoryTest : public GlTest {};

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST_F(ExtremesHistoryTest, AMeanAfterAMillionFramesDoesNotDriftOverManyMore) {
    constexpr std::uint32_t million = 1u << 20;
    constexpr int more = 32768;
    const glm::dvec3 start_mean(0.7, 1.9, 0.4);
    const NoisyFrames frames;
    Accumulator sums;
    sums.start_after(million, start_mean, 0.5);
    std::vector<glm::dvec3> total(Accumulator::pixels, start_mean * static_cast<double>(million));
    std::vector<double> plain(Accumulator::pixels), deviations(Accumulator::pixels, 0.5 * million);
    std::fill(plain.begin(), plain.end(), static_cast<float>(start_mean.x * million));
    for (int k = 0; k < more; ++k) {
        sums.add(frames.texture(k));
        for (int i = 0; i < Accumulator::pixels; ++i) {
            const glm::dvec3 value = frames.value_of(k, i);
            const double n = static_cast<double>(million) + k;
            const double deviation = luminance(value) - luminance(total[i] / n);
            deviations[i] += deviation * deviation * (n / (n + 1));
            total[i] += value;
            plain[i] = static_cast<float>(plain[i] + value.x);
        }
    }
    EXPECT_EQ(sums.frames(), million + more);
    const Accumulator::Values mean = sums.mean();
    double worst_plain = 0;
    for (int i = 0; i < Accumulator::pixels; ++i) {
        for (int c = 0; c < 3; ++c) {
            const double expected = total[i][c] / sums.frames();
            // Two roundings to float32: of the sum with its correction, and of the quotient.
            EXPECT_NEAR(mean[i][c], expected, 1.2e-7 * expected) << i << " " << c;
        }
        worst_plain = std::max(worst_plain, std::abs(plain[i] / total[i].x - 1));
        // Deviations from a mean that is float32, of luminances of 1 or so.
        EXPECT_NEAR(sums.variance(i), deviations[i] / sums.frames(), 1e-6 * sums.variance(i)) << i;
    }
    EXPECT_GT(worst_plain, 1e-6) << "what a plain float32 sum would lose";
    EXPECT_EQ(sums.rejected(), 0u);
}

TEST_F(ExtremesHistoryTest, TheFrameCounterStopsBeforeItWrapsAndTheMeanStays) {
    const glm::dvec3 start_mean(0.7, 1.9, 0.4);
    const NoisyFrames frames;
    Accumulator sums;
    sums.start_after(FRAMES_KEPT_MAX - 3, start_mean, 0.5);
    for (int k = 0; k < 8; ++k) {
        sums.add(frames.texture(k));
        for (const glm::vec4& mean : sums.mean())
            // A frame of 30 at most moves a mean of 2^32 by 1e-8; the mean itself is float32.
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], start_mean[c], 2e-7 * start_mean[c]) << k;
    }
    EXPECT_EQ(sums.frames(), FRAMES_KEPT_MAX);
    const Accumulator::Values last = sums.mean();
    Accumulator::Values glare;
    glare.fill(glm::vec4(1e10f));
    sums.add(Accumulator::make_texture(glare));
    EXPECT_EQ(sums.mean(), last);
    EXPECT_EQ(sums.rejected(), 0u);
}

TEST_F(ExtremesHistoryTest, WhatIsNotFiniteIsForgottenAfterAnyNumberOfFrames) {
    const NoisyFrames frames;
    for (const std::uint32_t after : {1u, 4097u, (1u << 24) + 1, 20000001u, 0xfffffff0u}) {
        Accumulator sums;
        sums.start_after(after, {1, 1, 1}, 0.5);
        sums.write_sum({1, nan, 1, 1});
        for (int k = 0; k < 3; ++k) {
            sums.add(frames.texture(k));
            EXPECT_EQ(sums.rejected(), std::uint32_t{Accumulator::pixels}) << "once a pixel, in one frame";
            const Accumulator::Values mean = sums.mean();
            for (int i = 0; i < Accumulator::pixels; ++i) {
                glm::dvec3 least(INFINITY), most(0), sum(0);
                for (int j = 0; j <= k; ++j) {
                    least = glm::min(least, frames.value_of(j, i));
                    most = glm::max(most, frames.value_of(j, i));
                    sum += frames.value_of(j, i) / (k + 1.0);
                }
                for (int c = 0; c < 3; ++c) {
                    EXPECT_GE(mean[i][c], least[c] * (1 - 2e-7)) << after << " frame " << k;
                    EXPECT_LE(mean[i][c], most[c] * (1 + 2e-7)) << after << " frame " << k;
                    // From 2^24 on the first of the new frames may count for more than one.
                    if (after >= 1u << 24) continue;
                    EXPECT_NEAR(mean[i][c], sum[c], 2e-7 * sum[c]) << after << " frame " << k;
                }
            }
        }
    }
}

// Every texture of the process with that label.
std::vector<GLuint> textures_called(const std::string& label) {
    std::vector<GLuint> found;
    for (GLuint name = 1; name < 4096; ++name) {
        if (glIsTexture(name) == GL_FALSE) continue;
        char text[64] = "";
        glGetObjectLabel(GL_TEXTURE, name, sizeof(text), nullptr, text);
        if (label == text) found.push_back(name);
    }
    return found;
}

TEST_F(ExtremesHistoryTest, WhatIsNotFiniteInHistoryIsCountedOnceAPixelAndGoneInOneFrame) {
    struct Case {
        History history;
        const char* texture;
    };
    const glm::ivec2 size(16, 12), min(3, 2), max(9, 7);
    const auto inside = [&](int x, int y) {
        // Row 0 of a picture is its top, of a texture its bottom.
        const int row = size.y - 1 - y;
        return x >= min.x && x < max.x && row >= min.y && row < max.y;
    };
    for (const auto& [history, label] :
         {Case{History::Blend, "history"}, Case{History::Count, "history"}, Case{History::Exact, "sum"},
          Case{History::Exact, "correction"}, Case{History::Exact, "filtered"}}) {
        for (const float poison : {nan, infinity, -infinity}) {
            SCOPED_TRACE(fmt::format("{} {} {}", static_cast<int>(history), label, poison));
            Scene scene = noisy_floor();
            Studio single(scene);
            scene.settings.history = history;
            Studio kept(scene);
            Studio healthy(scene);
            single.shoot(size);
            healthy.shoot(size);
            const std::vector<GLuint> before = textures_called(label);
            kept.shoot(size);
            std::vector<GLuint> made = textures_called(label);
            std::erase_if(made, [&](GLuint name) { return std::ranges::find(before, name) != before.end(); });
            ASSERT_EQ(made.size(), 2u) << "the last frame's and the one before";
            for (int frame = 1; frame < 5; ++frame) {
                single.shoot(size);
                healthy.shoot(size);
                EXPECT_EQ(kept.shoot(size).rejected, 0u);
            }
            const glm::ivec2 box = max - min;
            const std::vector<glm::vec4> values(std::size_t{1} * box.x * box.y, glm::vec4(poison));
            for (const GLuint name : made)
                glTextureSubImage2D(name, 0, min.x, min.y, box.x, box.y, GL_RGBA, GL_FLOAT, values.data());

            Picture fresh_mean;
            for (int frame = 1; frame <= 4; ++frame) {
                const Picture fresh = single.shoot(size);
                const double weight = history == History::Blend ? 0.1 : 1.0 / frame;
                fresh_mean = frame == 1 ? fresh : mixed(fresh_mean, fresh, weight);
                const Picture expected = healthy.shoot(size);
                const Picture picture = kept.shoot(size);
                EXPECT_EQ(picture.rejected, std::uint64_t{1} * box.x * box.y) << "in the first frame alone";
                for (int y = 0; y < size.y; ++y) {
                    for (int x = 0; x < size.x; ++x) {
                        if (!inside(x, y)) {
                            EXPECT_EQ(picture.at(x, y), expected.at(x, y)) << x << ", " << y;
                            continue;
                        }
                        // float32 means of a few values up to 3.
                        const double tolerance = frame == 1 ? 0 : 1e-6;
                        for (int c = 0; c < 3; ++c)
                            EXPECT_NEAR(picture.at(x, y)[c], fresh_mean.at(x, y)[c], tolerance)
                                << x << ", " << y;
                    }
                }
            }
        }
    }
}

TEST_F(ExtremesHistoryTest, TheFrameIndexWrapsToTheFirstFramesAndHistoryGoesOn) {
    const glm::ivec2 size(24, 16);
    constexpr std::uint64_t wrap = std::uint64_t{1} << 32;
    Studio first(noisy_floor());
    Studio wrapping(noisy_floor());
    wrapping.renderer.set_frame_index(wrap - 2);
    const Picture last_but_one = wrapping.shoot(size);
    const Picture last = wrapping.shoot(size);
    EXPECT_NE(last_but_one.image.pixels, last.image.pixels);
    for (int frame = 0; frame < 3; ++frame) {
        const Picture picture = wrapping.shoot(size);
        EXPECT_EQ(picture.image.pixels, first.shoot(size).image.pixels) << frame;
        EXPECT_NE(picture.image.pixels, last.image.pixels);
    }
    for (const History history : {History::Count, History::Exact}) {
        Studio single(noisy_floor());
        Studio kept(noisy_floor());
        kept.settings().history = history;
        for (Studio* studio : {&single, &kept}) studio->renderer.set_frame_index(wrap - 3);
        Picture expected;
        for (int frame = 0; frame < 8; ++frame) {
            const Picture fresh = single.shoot(size);
            expected = frame == 0 ? fresh : mixed(expected, fresh, 1.0 / (frame + 1));
            const Picture picture = kept.shoot(size);
            for (std::size_t i = 0; i < expected.image.pixels.size(); ++i)
                EXPECT_NEAR(picture.image.pixels[i], expected.image.pixels[i], 1e-5) << frame;
            EXPECT_EQ(picture.rejected, 0u);
        }
    }
}

}  // namespace
}  // namespace tarn
