// Does it run at all, in under a minute: an EGL context, a tick that moves water, a frame whose pixels are
// known.
#include <gtest/gtest.h>

#include <cmath>

#include "app/app.h"
#include "gpu/gl_test.h"

namespace tarn {
namespace {

using SmokeTest = GlTest;

constexpr glm::ivec2 size_px{48, 32};

ImageRgb32f one_frame(Scene scene) {
    const Settings settings = scene.settings;
    App app(std::move(scene), settings, {});
    Input input;
    input.size_px = size_px;
    app.frame(input);
    EXPECT_EQ(app.renderer().rejected_samples(), 0u);
    return app.renderer().read_radiance();
}

Scene exact_scene(const char* name) {
    Settings base;
    apply_quality(base, Quality::Exact);
    return load_scene(name, base);
}

TEST_F(SmokeTest, context_is_4_5) {
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    EXPECT_GE(major * 10 + minor, 45);
}

TEST_F(SmokeTest, a_tick_moves_water_and_loses_none) {
    const Scene scene = load_scene("dam-break", Settings{});
    gl::Timers timers;
    Simulation simulation(scene, timers);
    simulation.step(2, scene.settings);  // in the first the blocks may all lie within the water
    EXPECT_EQ(simulation.tick(), 2u);
    const Cells cells = simulation.read_cells();
    EXPECT_NE(hash_of(cells), hash_of(scene.cells));
    EXPECT_EQ(take_census(cells).water_quanta, take_census(scene.cells).water_quanta);
    EXPECT_GT(take_census(scene.cells).water_quanta, 0u);
}

TEST_F(SmokeTest, furnace_glows_as_computed) {
    constexpr int bounces = 4;
    Scene scene = exact_scene("furnace");
    scene.settings.max_bounces = bounces;
    scene.settings.light_sampling = LightSampling::None;
    scene.settings.roulette_after = 1024;
    const ImageRgb32f image = one_frame(std::move(scene));
    ASSERT_EQ(image.pixels.size(), std::size_t{3} * size_px.x * size_px.y);
    const auto expected = static_cast<float>(1 - std::pow(0.5, bounces + 1));
    for (const float value : image.pixels) ASSERT_FLOAT_EQ(value, expected);
}

// Level, over a horizon that splits the picture: above it sky of the known gradient, below it lit ground.
TEST_F(SmokeTest, flat_has_sky_above_and_grass_below) {
    Scene scene = exact_scene("flat");
    Settings& s = scene.settings;
    s.camera_yaw_deg = 0;
    s.camera_pitch_deg = 0;
    s.camera_fov_deg = 60;
    s.jitter = false;
    const glm::vec3 zenith = s.sky_zenith, horizon = s.sky_horizon;
    const ImageRgb32f image = one_frame(std::move(scene));
    const auto pixel = [&](int x, int y) {
        const std::size_t at = std::size_t{3} * (std::size_t(y) * size_px.x + x);
        return glm::vec3(image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]);
    };
    for (int y = 0; y < size_px.y / 2; ++y) {
        for (int x = 0; x < size_px.x; ++x) {
            const float half = std::tan(glm::radians(30.0f));
            const float up = half * (1 - (2 * static_cast<float>(y) + 1) / size_px.y);
            const float side =
                half * ((2 * static_cast<float>(x) + 1) / size_px.x - 1) * size_px.x / size_px.y;
            const glm::vec3 sky = glm::mix(horizon, zenith, up / std::sqrt(1 + up * up + side * side));
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel(x, y)[c], sky[c], 1e-4f) << x << ' ' << y;
        }
    }
    glm::vec3 ground(0);
    for (int x = 0; x < size_px.x; ++x) ground += pixel(x, size_px.y - 1) / static_cast<float>(size_px.x);
    EXPECT_GT(ground.g, ground.r);
    EXPECT_GT(ground.r, ground.b);
    EXPECT_GT(ground.g, 0.05f);
    EXPECT_LT(ground.g, 2.0f);
}

}  // namespace
}  // namespace tarn
