// The estimated error of a picture against the spread of independent pictures made alike.
#include <gtest/gtest.h>

#include <cmath>

#include "app/renderer.h"
#include "gl_test.h"

namespace tarn {
namespace {

constexpr glm::ivec2 size_px{24, 16};
constexpr int pictures = 40;

// Blocks under a sky: what lies in shadow is noisy.
Scene blocks() {
    Settings settings;
    apply_quality(settings, Quality::Exact);
    return parse_scene(R"({"size": [24, 16, 24],
        "camera": {"position_vox": [12, 10, 23], "pitch_deg": -30, "fov_deg": 60},
        "sun": {"irradiance": [0, 0, 0]},
        "build": [{"box": {"min": [0, 0, 0], "max": [24, 1, 24], "material": "grass"}},
                  {"box": {"min": [4, 1, 4], "max": [10, 9, 10], "material": "stone"}}]})",
                       "blocks", settings);
}

struct Found {
    double predicted = 0, true_error = 0;
};

// Both as means over independent pictures of `frames` frames.
Found look(const Scene& scene, const Settings& settings, int frames) {
    gl::Timers timers;
    Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    renderer.keep_variance(true);
    const std::size_t pixels = std::size_t{1} * size_px.x * size_px.y;
    std::vector<double> sum(pixels, 0);
    std::vector<double> squares(pixels, 0);
    Found found;
    for (int i = 0; i < pictures; ++i) {
        renderer.reset_history();
        for (int frame = 0; frame < frames; ++frame) renderer.render(simulation, settings, size_px);
        const ImageRgb32f image = renderer.read_radiance();
        for (std::size_t p = 0; p < pixels; ++p) {
            const float* rgb = &image.pixels[3 * p];
            const double y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
            sum[p] += y;
            squares[p] += y * y;
        }
        renderer.measure_error();
        const auto estimate = renderer.estimated_error(true);
        EXPECT_TRUE(estimate);
        found.predicted += estimate.value_or(0) / pictures;
    }
    double mean = 0;
    for (const double s : sum) mean += s / pictures / static_cast<double>(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
        const double y = sum[p] / pictures;
        const double variance = std::max(0.0, squares[p] / pictures - y * y) * pictures / (pictures - 1);
        found.true_error += variance / (y * y + 0.01 * mean * mean) / static_cast<double>(pixels);
    }
    return found;
}

TEST_F(GlTest, ExactModeKnowsItsNoise) {
    const Scene scene = blocks();
    Settings settings = scene.settings;
    settings.jitter = false;
    // Relative to the picture itself: with few samples noise divides noise, and the estimate comes out high.
    for (const auto& [frames, tolerance] : {std::pair(4, 0.3), std::pair(32, 0.12)}) {
        const Found found = look(scene, settings, frames);
        EXPECT_GT(found.true_error, 0);
        // Of 40 pictures of 384 pixels the spread itself is known to some percent.
        EXPECT_NEAR(found.predicted / found.true_error, 1, tolerance) << frames;
    }
}

TEST_F(GlTest, ARunningMeanKnowsItsNoiseBeforeTheFilter) {
    const Scene scene = blocks();
    Settings settings = scene.settings;
    settings.jitter = false;
    settings.history = History::Count;
    settings.history_cap = 64;
    const Found found = look(scene, settings, 16);
    EXPECT_NEAR(found.predicted / found.true_error, 1, 0.25);
}

TEST_F(GlTest, NothingIsSaidWithoutFramesToCompareOrWhereNothingIsKept) {
    const Scene scene = blocks();
    Settings settings = scene.settings;
    gl::Timers timers;
    Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    EXPECT_FALSE(renderer.estimated_error(true));
    renderer.render(simulation, settings, size_px);
    renderer.measure_error();
    EXPECT_FALSE(renderer.estimated_error(true));  // one frame
    settings.history = History::Count;
    for (int i = 0; i < 4; ++i) renderer.render(simulation, settings, size_px);
    renderer.measure_error();
    EXPECT_FALSE(renderer.estimated_error(true));  // not kept
    renderer.keep_variance(true);
    for (int i = 0; i < 4; ++i) renderer.render(simulation, settings, {40, 9});
    renderer.measure_error();
    EXPECT_TRUE(renderer.estimated_error(true));
    settings.history = History::None;
    renderer.render(simulation, settings, size_px);
    renderer.measure_error();
    EXPECT_FALSE(renderer.estimated_error(true));
    // The picture is the same with and without.
    settings.history = History::Count;
    std::vector<float> images[2];
    for (const bool kept : {false, true}) {
        renderer.keep_variance(kept);
        renderer.reset_history();
        renderer.set_frame_index(7);
        for (int i = 0; i < 5; ++i) renderer.render(simulation, settings, size_px);
        images[kept ? 1 : 0] = renderer.read_radiance().pixels;
    }
    EXPECT_EQ(images[0], images[1]);
}

}  // namespace
}  // namespace tarn
