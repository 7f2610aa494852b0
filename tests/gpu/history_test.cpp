// History and filters. Single frames come from a second renderer at the same frame index, whose random
// numbers are the same.
#include "app/camera.h"
#include "studio.h"

namespace tarn {
namespace {

class HistoryTest : public GlTest {};

double largest_difference(const Picture& a, const Picture& b) {
    if (a.image.pixels.size() != b.image.pixels.size()) return INFINITY;
    double most = 0;
    for (std::size_t i = 0; i < a.image.pixels.size(); ++i)
        most = std::max(most, std::abs(double{a.image.pixels[i]} - b.image.pixels[i]));
    return most;
}

double red_variance(const Picture& picture) {
    return std::pow(picture.standard_error(), 2) * picture.image.width * picture.image.height;
}

TEST_F(HistoryTest, CountedHistoryIsTheMeanOfItsFramesUpToTheCap) {
    Studio single(noisy_floor());
    Studio counted(noisy_floor());
    counted.settings().history = History::Count;
    counted.settings().history_cap = 6;
    Picture expected;
    for (int frame = 0; frame < 20; ++frame) {
        const Picture picture = single.shoot({24, 16});
        expected = frame == 0 ? picture : mixed(expected, picture, 1.0 / std::min(frame + 1, 6));
        EXPECT_LT(largest_difference(counted.shoot({24, 16}), expected), 1e-5) << frame;
    }
    EXPECT_GT(red_variance(single.shoot({24, 16})), 0.01);
}

TEST_F(HistoryTest, ExactHistoryIsTheMeanOfAllFrames) {
    Studio single(noisy_floor());
    Studio exact(noisy_floor());
    exact.settings().history = History::Exact;
    Picture expected;
    for (int frame = 0; frame < 20; ++frame) {
        const Picture picture = single.shoot({24, 16});
        expected = frame == 0 ? picture : mixed(expected, picture, 1.0 / (frame + 1));
        EXPECT_LT(largest_difference(exact.shoot({24, 16}), expected), 1e-5) << frame;
    }
}

TEST_F(HistoryTest, BlendedHistoryKeepsItsConstantWeight) {
    Studio single(noisy_floor());
    Studio blended(noisy_floor());
    blended.settings().history = History::Blend;
    blended.settings().history_alpha = 0.3f;
    Picture expected;
    for (int frame = 0; frame < 12; ++frame) {
        const Picture picture = single.shoot({24, 16});
        expected = frame == 0 ? picture : mixed(expected, picture, 0.3);
        EXPECT_LT(largest_difference(blended.shoot({24, 16}), expected), 1e-5) << frame;
    }
}

TEST_F(HistoryTest, AMovingEyeLeavesNoGhostOfAnotherMaterialNormalOrPlane) {
    for (const History history : {History::Count, History::Blend}) {
        Studio single(sunlit_slabs());
        Studio kept(sunlit_slabs());
        kept.settings().history = history;
        double brightest = 0;
        for (int frame = 0; frame < 12; ++frame) {
            for (Studio* studio : {&single, &kept}) {
                Settings& s = studio->settings();
                const float t = static_cast<float>(frame);
                s.camera_position_vox = {10 + 0.63f * t, 34 - 0.4f * t, 14 + 0.37f * t};
                s.camera_yaw_deg = 1.7f * t;
                s.camera_pitch_deg = -80 + 1.3f * t;
            }
            const Picture fresh = single.shoot({61, 43});
            EXPECT_LT(largest_difference(kept.shoot({61, 43}), fresh), 1e-5) << frame;
            brightest = std::max(brightest, fresh.mean().x);
        }
        EXPECT_GT(brightest, 0.01);
    }
}

TEST_F(HistoryTest, AMovingEyeKeepsTheHistoryOfASurface) {
    Studio single(noisy_floor());
    Studio kept(noisy_floor());
    kept.settings().history = History::Count;
    Picture first, last;
    for (int frame = 0; frame < 16; ++frame) {
        first = single.shoot({48, 32});
        last = kept.shoot({48, 32});
        kept.settings().camera_position_vox.x += 0.03f;
        kept.settings().camera_yaw_deg += 0.2f;
    }
    EXPECT_LT(red_variance(last), 0.2 * red_variance(first));
    EXPECT_NEAR(last.mean().x, first.mean().x, 0.1 * first.mean().x);
}

TEST_F(HistoryTest, ACutNeverMixesTheOldViewIntoTheNew) {
    Studio single(noisy_floor());
    Studio kept(noisy_floor());
    kept.settings().history = History::Count;
    const auto both = [&] { return largest_difference(single.shoot({16, 16}), kept.shoot({16, 16})); };
    for (int frame = 0; frame < 3; ++frame) both();
    EXPECT_GT(both(), 0.1);
    kept.renderer.reset_history();
    EXPECT_EQ(both(), 0);
    EXPECT_GT(both(), 0.1);
    for (Studio* studio : {&single, &kept}) studio->settings().sky_zenith = {1, 2, 3};
    EXPECT_EQ(both(), 0) << "the sky changed";
}

TEST_F(HistoryTest, ABrickThatChangedKeepsAFewFramesAndOthersKeepThemAll) {
    // A cube is put into a low sun: its shadow falls within its own brick and beyond.
    Scene scene = plain_scene(R"({"size": [16, 8, 16],
        "camera": {"position_vox": [7, 22, 12.5], "pitch_deg": -90, "fov_deg": 40},
        "sun": {"azimuth_deg": 90, "elevation_deg": 16.7, "irradiance": [8, 8, 8], "angular_radius_deg": 0},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "build": [{"box": {"min": [0, 0, 0], "max": [16, 1, 16], "material": "wall"}}]})");
    scene.settings.max_bounces = 1;
    scene.settings.history = History::Count;
    scene.settings.history_cap = 100;
    const glm::ivec2 size(64, 64);
    const auto pixel_of = [&](glm::vec3 point) {
        const auto px = View(scene.settings, size).project(point, point);
        return glm::ivec2((*px)[0]);
    };
    const glm::ivec2 near = pixel_of({9.5, 1, 12.5});
    const glm::ivec2 far = pixel_of({4.5, 1, 12.5});
    Studio studio(std::move(scene));
    Picture picture;
    for (int frame = 0; frame < 30; ++frame) picture = studio.shoot(size);
    const double lit = picture.at(near.x, near.y).x;
    EXPECT_GT(lit, 0.1);
    EditHistory edits;
    edits.begin_stroke();
    studio.simulation.apply(
        {.shape = BrushShape::Cube, .center_vox = {12, 2, 12}, .radius_vox = 1, .material = MATERIAL_STONE},
        edits);
    for (int frame = 1; frame <= 10; ++frame) {
        picture = studio.shoot(size);
        // FRAMES_KEPT_NEAR_CHANGE is 3: the shadow is the fourth frame of the mean.
        EXPECT_NEAR(picture.at(near.x, near.y).x, lit * 3 / (3 + frame), 1e-5) << frame;
        EXPECT_NEAR(picture.at(far.x, far.y).x, lit * 30 / (30 + frame), 1e-5) << frame;
    }
}

// The binomial blur along one axis, borders clamped.
Picture blurred(const Picture& in, glm::ivec2 step) {
    constexpr double weights[] = {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0};
    Picture out = in;
    const int width = in.image.width;
    const int height = in.image.height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0);
            for (int i = -2; i <= 2; ++i)
                sum += weights[i + 2] * in.at(std::clamp(x + i * step.x, 0, width - 1),
                                              std::clamp(y + i * step.y, 0, height - 1));
            for (int c = 0; c < 3; ++c)
                out.image.pixels[3 * (x + std::size_t{1} * y * width) + c] = static_cast<float>(sum[c]);
        }
    return out;
}

TEST_F(HistoryTest, TheGaussianIsTheBinomialOfTheUnfilteredPicture) {
    for (const int passes : {1, 2, 3}) {
        Studio single(noisy_floor());
        Studio filtered(noisy_floor());
        filtered.settings().filter = Filter::Gaussian;
        filtered.settings().filter_passes = passes;
        Picture expected = single.shoot({23, 17});
        for (int pass = 0; pass < passes; ++pass)
            expected = blurred(blurred(expected, {1 << pass, 0}), {0, 1 << pass});
        EXPECT_LT(largest_difference(filtered.shoot({23, 17}), expected), 1e-5) << passes;
    }
}

TEST_F(HistoryTest, TheEdgeAwareFilterStaysWithinMaterialNormalAndPlane) {
    for (const float pitch_deg : {-80.f, -50.f}) {
        Studio single(sunlit_slabs());
        Studio filtered(sunlit_slabs());
        filtered.settings().filter = Filter::EdgeAware;
        filtered.settings().filter_passes = 3;
        for (Studio* studio : {&single, &filtered}) studio->settings().camera_pitch_deg = pitch_deg;
        EXPECT_LT(largest_difference(filtered.shoot({61, 43}), single.shoot({61, 43})), 1e-5);
    }
}

// Half a floor lies in the shadow of its other half, a step higher.
TEST_F(HistoryTest, StairsAreOneSurfaceToTheFilterInTheFirstFrames) {
    const auto step = [](const char* material) {
        Scene scene = plain_scene(fmt::format(
            R"({{"size": [24, 12, 24], "camera": {{"position_vox": [12, 11, 12], "pitch_deg": -90, "fov_deg": 50}},
            "sun": {{"azimuth_deg": 90, "elevation_deg": 8, "irradiance": [6, 6, 6], "angular_radius_deg": 0}},
            "sky": {{"zenith": [0, 0, 0], "horizon": [0, 0, 0]}},
            "build": [{{"box": {{"min": [0, 0, 0], "max": [24, 1, 24], "material": "wall"}}}},
                      {{"box": {{"min": [12, 1, 0], "max": [24, 2, 24], "material": "{}"}}}}]}})",
            material));
        scene.settings.max_bounces = 1;
        scene.settings.light_sampling = LightSampling::Lights;
        scene.settings.history = History::Count;
        return scene;
    };
    for (const char* material : {"wall", "stone"}) {
        Studio single(step(material));
        Studio filtered(step(material));
        filtered.settings().filter = Filter::EdgeAware;
        for (int frame = 1; frame <= 4; ++frame) {
            const double apart = largest_difference(filtered.shoot({48, 32}), single.shoot({48, 32}));
            if (frame < 3 && material == std::string("wall"))
                EXPECT_GT(apart, 0.05) << frame;
            else
                EXPECT_LT(apart, 1e-5) << material << frame;
        }
    }
}

TEST_F(HistoryTest, AFlightKeepsFewFramesAndAJumpFewer) {
    Studio studio(noisy_floor());
    studio.settings().history = History::Count;
    const auto kept = [&] {
        studio.settings().view = ViewKind::History;
        const Picture frames = studio.shoot({24, 16});
        studio.settings().view = ViewKind::Picture;
        return frames.at(12, 8).x;
    };
    for (int frame = 0; frame < 20; ++frame) studio.shoot({24, 16});
    EXPECT_EQ(kept(), 21);
    studio.settings().camera_position_vox.x += 0.03f;
    EXPECT_EQ(kept(), 13);
    EXPECT_EQ(kept(), 14);
    studio.settings().camera_position_vox.x += 4;
    EXPECT_LT(kept(), 8);
}

TEST_F(HistoryTest, TheEdgeAwareFilterAveragesNoiseWithinAPlaneAndLessOfItThereIsLess) {
    Studio single(noisy_floor());
    Studio filtered(noisy_floor());
    for (Studio* studio : {&single, &filtered}) studio->settings().history = History::Count;
    filtered.settings().filter = Filter::EdgeAware;
    for (int frame = 1; frame <= 12; ++frame) {
        const Picture noise = single.shoot({64, 64});
        const Picture calm = filtered.shoot({64, 64});
        if (frame != 1 && frame != 3 && frame != 12) continue;
        // Of sides, corners and sides two steps away, beside the pixel's own 1.
        const double strength = std::min(1.0, 2.0 / frame);
        const double weights[] = {0.9, frame < 4 ? 0.7 : 0.0, frame < 3 ? 0.4 : 0.0};
        double sum = 1;
        double squares = 1;
        for (const double w : weights) {
            sum += 4 * strength * w;
            squares += 4 * strength * strength * w * w;
        }
        const double expected = squares / (sum * sum);
        EXPECT_NEAR(red_variance(calm) / red_variance(noise), expected, 0.15 * expected) << frame;
        EXPECT_NEAR(calm.mean().x, noise.mean().x, 0.02 * noise.mean().x);
    }
}

TEST_F(HistoryTest, SamplesThatOverflowAreRejectedCountedAndStayWhereTheyAre) {
    // Two mirrors of light face each other, each too bright for a float to hold both. Beside them: black
    // walls that shine.
    Scene scene = plain_scene(R"({"size": [16, 12, 16],
        "camera": {"position_vox": [8, 6, 8], "pitch_deg": -90, "fov_deg": 40}, "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"metal": {"base_color": [1, 1, 1], "roughness": 0, "metallic": 1},
                      "stone": {"base_color": [0, 0, 0], "emission": [0.5, 0.5, 0.5]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [16, 1, 16], "material": "stone"}},
                  {"box": {"min": [8, 0, 0], "max": [16, 1, 16], "material": "metal"}},
                  {"box": {"min": [0, 11, 0], "max": [16, 12, 16], "material": "metal"}}]})");
    scene.materials[MATERIAL_METAL].emission = glm::vec3(3e38f);
    scene.settings.max_bounces = 1;
    for (const History history : {History::None, History::Blend, History::Count, History::Exact}) {
        scene.settings.history = history;
        scene.settings.filter = history == History::Exact ? Filter::None : Filter::EdgeAware;
        Studio studio(scene);
        Picture picture;
        for (int frame = 0; frame < 4; ++frame) picture = studio.shoot({32, 32});
        EXPECT_EQ(picture.rejected, 4u * 16 * 32) << "half of the picture in each frame";
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) EXPECT_EQ(picture.at(x, y).x, x < 16 ? 0.5 : 0.0) << x << ", " << y;
    }
}

TEST_F(HistoryTest, WhatIsNotFiniteInHistoryIsForgotten) {
    // Two samples, each finite, may sum to more than a float holds.
    Scene scene = noisy_floor();
    scene.settings.sky_zenith = scene.settings.sky_horizon = glm::vec3(0);
    for (int z = 0; z < 32; ++z)
        for (int x = 0; x < 16; ++x) scene.cells.at({x, 11, z}) = MATERIAL_LAMP;
    scene.materials[MATERIAL_LAMP].emission = glm::vec3(3.4e38f);
    scene.materials[MATERIAL_WALL].base_color = glm::vec3(1);
    scene.settings.camera_position_vox.y = 10;
    scene.settings.samples_per_pixel = 2;
    Studio single(scene);
    scene.settings.history = History::Count;
    Studio kept(scene);
    for (int frame = 0; frame < 12; ++frame) {
        const Picture fresh = single.shoot({32, 32});
        const Picture picture = kept.shoot({32, 32});
        for (std::size_t i = 0; i < fresh.image.pixels.size(); ++i)
            ASSERT_TRUE(std::isfinite(picture.image.pixels[i]) || !std::isfinite(fresh.image.pixels[i]))
                << frame;
    }
}

double mean_squared_error(const Picture& a, const Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.image.pixels.size(); ++i)
        sum += std::pow(double{a.image.pixels[i]} - b.image.pixels[i], 2);
    return sum / static_cast<double>(a.image.pixels.size());
}

// Bars of two materials, six wide, across x at heights [low, high), along z in [from, to); `odd`: begun by
// the other one.
std::string bars(int low, int high, int from, int to, bool odd = false) {
    std::string text;
    for (int x = 0; x < 96; x += 6)
        text += fmt::format(R"({{"box": {{"min": [{}, {}, {}], "max": [{}, {}, {}], "material": "{}"}}}},)",
                            x, low, from, x + 6, high, to, (x % 4 == 0) != odd ? "wall" : "dirt");
    return text;
}

std::string squares(int low, int high) {
    std::string text;
    for (int z = 0; z < 48; z += 6) text += bars(low, high, z, z + 6, z % 4 != 0);
    return text;
}

// After a flight of `step_vox` a frame, in which the image glides over the surface: the error of the last
// picture over that of one without history.
double error_after_flight(Scene scene, float resolution_scale, glm::vec3 step_vox) {
    scene.settings.history = History::Count;
    scene.settings.history_cap = 32;
    scene.settings.caustics = false;  // rare and bright beyond measure
    scene.settings.resolution_scale = resolution_scale;
    constexpr glm::ivec2 size{96, 64};
    constexpr int frames = 24;
    Studio studio(scene);
    Picture picture;
    for (int frame = 0; frame < frames; ++frame) {
        studio.settings().camera_position_vox += step_vox;
        picture = studio.shoot(size);
    }
    Settings exact = studio.settings();
    exact.resolution_scale = 1;
    exact.history = History::None;
    Renderer fresh(studio.scene, studio.timers);
    fresh.render(studio.simulation, exact, size);
    const Picture single{fresh.read_radiance(), 0};
    exact.history = History::Exact;
    Renderer reference(studio.scene, studio.timers);
    for (int frame = 0; frame < 256; ++frame) reference.render(studio.simulation, exact, size);
    const Picture expected{reference.read_radiance(), 0};
    return mean_squared_error(picture, expected) / mean_squared_error(single, expected);
}

// What is left of a frame's error after a flight, with all pixels traced and with fewer.
void expect_followed(const char* what, const Scene& scene, double bar, glm::vec3 step_vox = {0.25f, 0, 0}) {
    for (const float scale : {1.0f, 0.55f}) {
        const double error = error_after_flight(scene, scale, step_vox);
        fmt::print("{}, scale {}: {:.3f} of the error of one frame\n", what, scale, error);
        EXPECT_LT(error, bar) << what << ", scale " << scale;
    }
}

TEST_F(HistoryTest, OnAFlightFollowsTheBedUnderWater) {
    const Scene scene = plain_scene(
        R"({"size": [96, 32, 48], "camera": {"position_vox": [40, 28, 44], "pitch_deg": -42, "fov_deg": 40},
            "sun": {"azimuth_deg": 200, "elevation_deg": 60, "irradiance": [4, 4, 4]},
            "build": [{"box": {"min": [0, 4, 0], "max": [96, 20, 48], "material": "water"}},)" +
        squares(0, 4) + R"({"box": {"min": [0, 0, 0], "max": [96, 1, 48], "material": "stone"}}]})");
    expect_followed("bed, to the side", scene, 0.22);
    expect_followed("bed, ahead", scene, 0.5, {0, 0, -0.25f});
}

TEST_F(HistoryTest, OnAFlightFollowsWhatAMirrorShows) {
    const Scene scene = plain_scene(
        R"({"size": [96, 32, 64], "camera": {"position_vox": [40, 16, 30], "pitch_deg": 0, "fov_deg": 12},
            "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [6, 4, 2], "horizon": [0, 0, 0]},
            "materials": {"metal": {"base_color": [1, 1, 1], "roughness": 0, "metallic": 1}},
            "build": [{"box": {"min": [0, 0, 0], "max": [96, 32, 2], "material": "metal"}},)" +
        bars(0, 32, 60, 64) + R"({"box": {"min": [0, 0, 2], "max": [96, 1, 64], "material": "stone"}}]})");
    expect_followed("mirror", scene, 0.15);
}

TEST_F(HistoryTest, OnAFlightFollowsWhatIsBehindAPane) {
    const Scene scene = plain_scene(
        R"({"size": [96, 32, 48], "camera": {"position_vox": [40, 16, 46], "pitch_deg": 0, "fov_deg": 20},
            "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [6, 4, 2], "horizon": [0, 0, 0]},
            "build": [{"box": {"min": [0, 0, 34], "max": [96, 32, 37], "material": "glass"}},)" +
        bars(0, 32, 0, 4) + R"({"box": {"min": [0, 0, 4], "max": [96, 1, 34], "material": "stone"}}]})");
    expect_followed("pane", scene, 0.2);
}

}  // namespace
}  // namespace tarn
