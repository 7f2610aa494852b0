// The estimated error of a picture against the spread of independent pictures made alike, and against the
// truth.
#include <gtest/gtest.h>

#include <cmath>

#include "app/error_estimate.h"
#include "app/renderer.h"
#include "gl_test.h"
#include "passes/trace_programs.h"

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
        renderer.measure_error(simulation);
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

TEST_F(GlTest, ExactModeKnowsItsError) {
    const Scene scene = blocks();
    // Few samples are tried by others, many tell by their spread.
    for (const auto& [frames, tolerance] : {std::pair(4, 0.35), std::pair(80, 0.12)}) {
        const Found found = look(scene, scene.settings, frames);
        EXPECT_GT(found.true_error, 0);
        // Of 40 pictures of 384 pixels the spread itself is known to some percent.
        EXPECT_NEAR(found.predicted / found.true_error, 1, tolerance) << frames;
    }
}

TEST_F(GlTest, ARunningMeanKnowsItsError) {
    const Scene scene = blocks();
    Settings settings = scene.settings;
    settings.history = History::Count;
    settings.history_cap = 64;
    const Found found = look(scene, settings, 16);
    // A single trial of 384 pixels is often unsure, and the noise may say no more than it allows.
    EXPECT_NEAR(found.predicted / found.true_error, 1, 0.5);
}

// relMSE of the renderer's picture against the mean of many samples, and as estimated.
class Judge {
  public:
    explicit Judge(const Scene& scene) : simulation_(scene, timers_) {
        Renderer exact(scene, timers_);
        for (int i = 0; i < 3000; ++i) exact.render(simulation_, scene.settings, size_px);
        reference_ = exact.read_radiance();
    }
    double true_error(const Renderer& renderer) const {
        const ImageRgb32f image = renderer.read_radiance();
        const auto y = [](const ImageRgb32f& of, std::size_t p) {
            return 0.2126 * of.pixels[3 * p] + 0.7152 * of.pixels[3 * p + 1] + 0.0722 * of.pixels[3 * p + 2];
        };
        const std::size_t pixels = image.pixels.size() / 3;
        double mean = 0;
        for (std::size_t p = 0; p < pixels; ++p) mean += y(reference_, p) / static_cast<double>(pixels);
        double sum = 0;
        for (std::size_t p = 0; p < pixels; ++p) {
            const double r = y(reference_, p);
            sum += std::pow(y(image, p) - r, 2) / (r * r + 0.01 * mean * mean) / static_cast<double>(pixels);
        }
        return sum;
    }
    // Of so many trials together.
    double estimate(Renderer& renderer, const Settings& settings, int trials) {
        for (int i = 0; i < trials; ++i) {
            renderer.render(simulation_, settings, size_px);
            renderer.measure_error(simulation_);
            EXPECT_TRUE(renderer.estimated_error(true));
        }
        return renderer.estimated_error(true).value_or(0);
    }
    gl::Timers& timers() { return timers_; }
    const Simulation& simulation() const { return simulation_; }

  private:
    gl::Timers timers_;
    Simulation simulation_;
    ImageRgb32f reference_;
};

TEST_F(GlTest, WhatAPictureLeavesOutCountsAsItsError) {
    const Scene scene = blocks();
    Judge judge(scene);
    Settings settings = scene.settings;
    settings.history = History::Count;
    settings.history_cap = 256;
    settings.refine_at_rest = false;
    settings.max_diffuse_bounces = 0;
    Renderer renderer(scene, judge.timers());
    renderer.keep_variance(true);
    for (int i = 0; i < 100; ++i) renderer.render(judge.simulation(), settings, size_px);
    const double estimate = judge.estimate(renderer, settings, 8);
    const double true_error = judge.true_error(renderer);
    EXPECT_GT(true_error, 0.05);
    EXPECT_GT(estimate, true_error / 1.7);
    EXPECT_LT(estimate, true_error * 1.7);
}

TEST_F(GlTest, ARefinedPictureKnowsHowFarItHasCome) {
    const Scene scene = blocks();
    Judge judge(scene);
    Settings settings = scene.settings;
    apply_quality(settings, Quality::Fast);
    Renderer renderer(scene, judge.timers());
    renderer.keep_variance(true);
    double before = 1;
    for (const std::uint64_t samples : {16, 80, 320}) {
        while (!renderer.is_refining() || renderer.samples() < samples)
            renderer.render(judge.simulation(), settings, size_px);
        const double estimate = judge.estimate(renderer, settings, 1);
        const double true_error = judge.true_error(renderer);
        EXPECT_LT(estimate, 0.7 * before) << samples;
        before = estimate;
        if (samples < 64) continue;  // one trial of 384 pixels
        EXPECT_GT(estimate, true_error / 2.5) << samples;
        EXPECT_LT(estimate, true_error * 2.5) << samples;
    }
}

TEST_F(GlTest, NothingIsSaidOfAPictureThatIsNoMore) {
    const Scene scene = blocks();
    Settings settings = scene.settings;
    gl::Timers timers;
    const Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    EXPECT_FALSE(renderer.estimated_error(true));
    renderer.keep_variance(true);
    for (int i = 0; i < 4; ++i) renderer.render(simulation, settings, size_px);
    renderer.measure_error(simulation);
    EXPECT_TRUE(renderer.estimated_error(true));
    // The answer under way is of the picture before.
    renderer.measure_error(simulation);
    renderer.keep_variance(false);
    EXPECT_FALSE(renderer.estimated_error(true));
    renderer.measure_error(simulation);
    renderer.reset_history();
    EXPECT_FALSE(renderer.estimated_error(true));
    // Sizes and histories of every kind.
    renderer.keep_variance(true);
    for (const History history : {History::None, History::Blend, History::Count}) {
        settings.history = history;
        for (const glm::ivec2 size : {glm::ivec2(40, 9), glm::ivec2(1, 1), size_px}) {
            for (int i = 0; i < 4; ++i) renderer.render(simulation, settings, size);
            renderer.measure_error(simulation);
            renderer.estimated_error(true);
        }
    }
    // The picture is the same with and without.
    settings.history = History::Count;
    std::vector<float> images[2];
    for (const bool kept : {false, true}) {
        renderer.keep_variance(kept);
        renderer.reset_history();
        renderer.set_frame_index(7);
        for (int i = 0; i < 5; ++i) {
            renderer.render(simulation, settings, size_px);
            if (kept) renderer.measure_error(simulation);
        }
        images[kept ? 1 : 0] = renderer.read_radiance().pixels;
    }
    EXPECT_EQ(images[0], images[1]);
}

// While the answer is under way: the last one or, where the GPU was quick, the new one.
TEST_F(GlTest, TheLastAnswerStandsUntilTheNextIsThere) {
    const Scene scene = blocks();
    gl::Timers timers;
    Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    renderer.keep_variance(true);
    const auto render = [&](int frames) {
        for (int i = 0; i < frames; ++i) renderer.render(simulation, scene.settings, size_px);
    };
    const auto expect_an_answer = [&](const char* when) {
        const auto before = renderer.estimated_error(true);
        ASSERT_TRUE(before) << when;
        render(1);
        renderer.measure_error(simulation);
        const auto at_once = renderer.estimated_error(false);
        const auto after = renderer.estimated_error(true);
        EXPECT_TRUE(at_once) << when;
        EXPECT_TRUE(at_once == before || at_once == after) << when;
    };
    render(10);
    renderer.measure_error(simulation);
    expect_an_answer("by trials");
    render(60);
    expect_an_answer("from trials to the spread");
    expect_an_answer("by the spread");
    // An edit makes another picture of the same size: earlier trials end, the line in the corner stays.
    EditHistory history;
    history.begin_stroke();
    simulation.apply({.tick = 0,
                      .shape = BrushShape::Sphere,
                      .center_vox = {16, 4, 14},
                      .radius_vox = 2,
                      .material = MATERIAL_STONE,
                      .overwrite = true},
                     history);
    simulation.step(0, scene.settings);
    expect_an_answer("after an edit");
}

// Views count paths by programs of their own; a trial is of the picture.
TEST_F(GlTest, ATrialLeavesTheChoiceOfThePicturesProgramAlone) {
    Scene scene = blocks();
    scene.settings.history = History::Count;
    gl::Timers timers;
    const Simulation simulation(scene, timers);
    TracePrograms programs(platform()->make_shared_context());
    Renderer renderer(scene, timers, &programs);
    renderer.keep_variance(true);
    for (const ViewKind view : {ViewKind::Picture, ViewKind::Bounces, ViewKind::Steps}) {
        Settings settings = scene.settings;
        settings.view = view;
        apply_quality(settings, Quality::Fast);
        for (int i = 0; i < 2; ++i) renderer.render(simulation, settings, size_px);
        const double waited_ms = programs.waited_ms();
        renderer.measure_error(simulation);
        EXPECT_EQ(programs.waited_ms(), waited_ms) << "the trial was built on the frame's thread";
        renderer.estimated_error(true);
    }
}

TEST(CombinedError, IsTheTrialsWhereThatIsSureElseTheNoise) {
    EXPECT_FALSE(combined_error({}, {}));
    EXPECT_EQ(combined_error(0.1, {}), 0.1);
    EXPECT_EQ(combined_error(0.1, Trial{0.5, 0.01}), 0.5);
    EXPECT_EQ(combined_error({}, Trial{0.5, 0.01}), 0.5);
    EXPECT_EQ(combined_error(0.1, Trial{0.15, 0.01}), 0.1);
    EXPECT_DOUBLE_EQ(*combined_error(0.9, Trial{0.15, 0.01}), 0.35);  // no more than the trial allows
    EXPECT_DOUBLE_EQ(*combined_error(0.9, Trial{-0.15, 0.01}), 0.2);
    EXPECT_FALSE(combined_error({}, Trial{0.15, 0.01}));
}

}  // namespace
}  // namespace tarn
