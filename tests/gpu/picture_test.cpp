// Pictures as they are shown: tone curve, sizes, presets, and the eye under water.
#include "studio.h"

namespace tarn {
namespace {

class PictureTest : public GlTest {};

// One wall that fills the view and shines.
Scene shining_wall(glm::vec3 radiance) {
    Scene scene = plain_scene(R"({"size": [8, 8, 2], "camera": {"position_vox": [4, 4, 4], "fov_deg": 20},
        "sun": {"irradiance": [0, 0, 0]}, "materials": {"lamp": {"base_color": [0, 0, 0]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [8, 8, 1], "material": "lamp"}}]})");
    scene.materials[MATERIAL_LAMP].emission = radiance;
    return scene;
}

double srgb_code(double linear) {
    linear = std::clamp(linear, 0.0, 1.0);
    return 255 * (linear < 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

TEST_F(PictureTest, LinearToneMappingGivesSrgbCodesAndStopsDouble) {
    const glm::vec3 radiance(1, 0.2140f, 0.003f);
    Studio studio(shining_wall(radiance));
    studio.settings().tone_map = ToneMap::Linear;
    for (float ev = -10; ev <= 4; ev += 0.5f) {
        studio.settings().exposure_ev = ev;
        studio.shoot({4, 4});
        const ImageRgba8 picture = studio.renderer.read_picture();
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(picture.pixels[c], srgb_code(std::exp2(ev) * radiance[c]), 0.55) << ev << " " << c;
        EXPECT_EQ(picture.pixels[3], 255);
    }
}

TEST_F(PictureTest, TheFilmicCurveRisesFromBlackToWhite) {
    Studio studio(shining_wall({1, 0.18f, 0}));
    int last = 0;
    for (float ev = -16; ev <= 20; ev += 0.5f) {
        studio.settings().exposure_ev = ev;
        studio.shoot({1, 1});
        const ImageRgba8 picture = studio.renderer.read_picture();
        EXPECT_GE(picture.pixels[0], last) << ev;
        EXPECT_LE(picture.pixels[0] - last, 28) << ev;
        EXPECT_EQ(picture.pixels[2], 0);
        if (ev == 0) {
            EXPECT_NEAR(picture.pixels[1], srgb_code(0.18), 16);
        }
        if (ev == -16) {
            EXPECT_EQ(picture.pixels[0], 0);
        }
        last = picture.pixels[0];
    }
    EXPECT_EQ(last, 255);
    // Whose square is beyond a float.
    Studio glaring(shining_wall({1e30f, 3e38f, 0}));
    glaring.shoot({1, 1});
    EXPECT_EQ(glaring.renderer.read_picture().pixels, (std::vector<std::uint8_t>{255, 255, 0, 255}));
}

TEST_F(PictureTest, AScaledPictureHasTheShownSizeAndTheSameMean) {
    for (const float scale : {0.5f, 0.25f, 0.7f}) {
        Studio full(sunlit_slabs());
        Studio scaled(sunlit_slabs());
        scaled.settings().resolution_scale = scale;
        const Picture expected = full.shoot({121, 83});
        const Picture picture = scaled.shoot({121, 83});
        EXPECT_EQ(picture.image.width, 121);
        EXPECT_EQ(picture.image.height, 83);
        EXPECT_EQ(scaled.renderer.read_picture().width, 121);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(picture.mean()[c], expected.mean()[c], 0.03 / scale * expected.mean()[c]);
        // Most pixels lie on one surface and are what they were.
        int same = 0;
        for (std::size_t i = 0; i < expected.image.pixels.size(); ++i)
            same += std::abs(picture.image.pixels[i] - expected.image.pixels[i]) < 1e-5f ? 1 : 0;
        EXPECT_GT(same, 0.7 * 3 * 121 * 83) << scale;
    }
}

TEST_F(PictureTest, AnySizeWorksAndAnyChangeOfItBetweenFrames) {
    Studio studio(noisy_floor());
    for (const Quality quality : {Quality::Balanced, Quality::Fast, Quality::Baseline, Quality::Exact}) {
        apply_quality(studio.settings(), quality);
        for (const glm::ivec2 size : {glm::ivec2(1, 1), {16384, 1}, {3, 200}, {1, 1}, {64, 36}}) {
            for (int frame = 0; frame < 2; ++frame) {
                const Picture picture = studio.shoot(size);
                EXPECT_EQ(glm::ivec2(picture.image.width, picture.image.height), size);
                EXPECT_TRUE(all_finite(picture));
            }
        }
    }
}

// A pond with a beach, glass, metal and a lamp.
Scene pond() {
    return scene_from(R"({"size": [32, 24, 32],
        "camera": {"position_vox": [16, 16, 31], "pitch_deg": -25, "fov_deg": 60},
        "sun": {"azimuth_deg": 60, "elevation_deg": 40},
        "build": [{"box": {"min": [0, 0, 0], "max": [32, 8, 32], "material": "water"}},
                  {"box": {"min": [0, 0, 0], "max": [32, 2, 32], "material": "stone"}},
                  {"box": {"min": [0, 0, 0], "max": [32, 10, 6], "material": "sand"}},
                  {"sphere": {"center": [10, 9, 16], "radius": 4, "material": "glass"}},
                  {"sphere": {"center": [22, 9, 14], "radius": 4, "material": "metal"}},
                  {"box": {"min": [15, 12, 4], "max": [17, 14, 6], "material": "lamp"}}]})");
}

TEST_F(PictureTest, EveryPresetShowsAPond) {
    for (const Quality quality :
         {Quality::Baseline, Quality::Fast, Quality::Balanced, Quality::Quality, Quality::Exact}) {
        Studio studio(pond());
        apply_quality(studio.settings(), quality);
        Picture picture;
        for (int frame = 0; frame < 3; ++frame) picture = studio.shoot({48, 27});
        EXPECT_TRUE(all_finite(picture));
        EXPECT_EQ(picture.rejected, 0u);
        EXPECT_GT(picture.mean().y, 0.02);
        EXPECT_LT(picture.mean().y, 20);
    }
}

TEST_F(PictureTest, SkippingBricksChangesNoBit) {
    Studio stepped(pond());
    Studio skipped(pond());
    for (Studio* studio : {&stepped, &skipped}) apply_quality(studio->settings(), Quality::Baseline);
    skipped.settings().traversal = Traversal::Distance;
    for (int frame = 0; frame < 3; ++frame) {
        const Picture a = stepped.shoot({64, 36});
        const Picture b = skipped.shoot({64, 36});
        EXPECT_EQ(a.image.pixels, b.image.pixels) << frame;
        EXPECT_EQ(stepped.renderer.read_picture().pixels, skipped.renderer.read_picture().pixels);
    }
}

TEST_F(PictureTest, FromUnderWaterTheSkyIsBrighterByTheIndexSquared) {
    // Black ground and a white sky: radiance comes down through the surface alone.
    Scene scene = scene_from(R"({"size": [64, 16, 64],
        "camera": {"position_vox": [32.5, 7, 32.5], "pitch_deg": 90, "fov_deg": 1},
        "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]},
        "materials": {"lamp": {"base_color": [0, 0, 0], "emission": [0, 0, 0]},
                      "water": {"ior": 1.333, "absorption_per_m": [0, 0, 0]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [64, 8, 64], "material": "lamp"}},
                  {"box": {"min": [1, 1, 1], "max": [63, 8, 63], "material": "water"}}]})");
    const double n = 1.333;
    for (const double angle_deg : {0.0, 30.0, 45.0, 60.0}) {
        scene.settings.camera_pitch_deg = static_cast<float>(90 - angle_deg);
        const double sine_beyond = n * std::sin(glm::radians(angle_deg));
        double expected = 0;
        if (sine_beyond < 1) {
            const double cos_i = std::cos(glm::radians(angle_deg));
            const double cos_t = std::sqrt(1 - sine_beyond * sine_beyond);
            const double across = (n * cos_i - cos_t) / (n * cos_i + cos_t);
            const double along = (cos_i - n * cos_t) / (cos_i + n * cos_t);
            expected = n * n * (1 - (across * across + along * along) / 2);
        }
        const Picture picture = picture_of(scene, 64, {16, 16});
        EXPECT_NEAR(picture.mean().x, expected, 0.01 * expected) << angle_deg;
        EXPECT_EQ(picture.rejected, 0u);
    }
}

}  // namespace
}  // namespace tarn
