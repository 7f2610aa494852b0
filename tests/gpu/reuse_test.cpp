// What earlier frames and neighbours are worth: fewer traced pixels than shown ones, changes of light that
// the cells of what is seen do not tell of, pictures at rest.
#include <map>
#include <memory>
#include <vector>

#include "app/replay.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "studio.h"
#include "world/edits.h"
#include "world/recording.h"

namespace tarn {
namespace {

class ReuseTest : public GlTest {};

double largest_difference(const Picture& a, const Picture& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.image.pixels.size(); ++i)
        most = std::max(most, std::abs(double{a.image.pixels[i]} - b.image.pixels[i]));
    return most;
}

TEST_F(ReuseTest, AStillPictureOfFewerTracedPixelsBecomesThatOfAll) {
    for (const float scale : {0.5f, 0.7f, 0.34f, 0.25f}) {
        Studio full(sunlit_slabs());
        Studio scaled(sunlit_slabs());
        scaled.settings().history = History::Count;
        scaled.settings().resolution_scale = scale;
        const Picture expected = full.shoot({61, 43});
        Picture picture;
        for (int frame = 0; frame < 32; ++frame) picture = scaled.shoot({61, 43});
        EXPECT_LT(largest_difference(picture, expected), 1e-4) << scale;
    }
}

TEST_F(ReuseTest, FewerTracedPixelsHaveTheSameMeanOnAFlight) {
    Studio full(noisy_floor());
    Studio scaled(noisy_floor());
    for (Studio* studio : {&full, &scaled}) studio->settings().history = History::Count;
    scaled.settings().resolution_scale = 0.5f;
    Picture expected, picture;
    for (int frame = 0; frame < 16; ++frame) {
        expected = full.shoot({48, 32});
        picture = scaled.shoot({48, 32});
        for (Studio* studio : {&full, &scaled}) studio->settings().camera_position_vox.x += 0.03f;
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.mean()[c], expected.mean()[c], 0.05 * expected.mean()[c]);
    EXPECT_LT(picture.standard_error(), 2 * expected.standard_error());
}

// Emission alone, so that all but lamps is black.
TEST_F(ReuseTest, LampsOfFewerTracedPixelsShineWhereTheyAre) {
    constexpr glm::ivec2 size{160, 90};
    constexpr float lit = 1;  // the lamps are 8 and more
    for (const bool guided : {false, true}) {
        Settings settings;
        apply_quality(settings, Quality::Balanced);
        settings.max_bounces = 0;
        settings.refine_at_rest = false;
        settings.antialiasing = 0;
        settings.guided_upsampling = guided;
        Studio scaled(load_scene("cave", settings));
        Studio full(load_scene("cave", settings));
        full.settings().resolution_scale = 1;
        full.settings().history = History::None;
        full.settings().filter = Filter::None;
        const Recording recording = load_recording("flying");
        const Settings start = full.settings();
        int lamps = 0, shown = 0, strays = 0;
        double spilt = 0;
        for (int frame = 0; frame < recording.frames(); ++frame) {
            for (Studio* studio : {&scaled, &full}) place_camera(recording, frame, start, studio->settings());
            const Picture picture = scaled.shoot(size);
            const Picture expected = full.shoot(size);
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    double around = 0;
                    for (int k = 0; k < 9; ++k) {
                        const glm::ivec2 tap = glm::ivec2(x, y) + glm::ivec2(k % 3, k / 3) - 1;
                        const glm::ivec2 there = glm::clamp(tap, glm::ivec2(0), size - 1);
                        around = std::max(around, expected.at(there.x, there.y).x);
                    }
                    lamps += expected.at(x, y).x > lit ? 1 : 0;
                    shown += expected.at(x, y).x > lit && picture.at(x, y).x > lit ? 1 : 0;
                    strays += picture.at(x, y).x > lit && around <= lit ? 1 : 0;
                    if (expected.at(x, y).x == 0) spilt += picture.at(x, y).x;
                }
        }
        EXPECT_GT(shown, (guided ? 0.9 : 0.5) * lamps);
        EXPECT_LT(strays, 6) << guided;  // bilinear: 299
        // A lamp's pixel is 8 and more. Bilinear: 5; guided, with lamps where a ray met nothing: 0.7.
        EXPECT_LT(spilt, (guided ? 0.1 : 0.4) * lamps) << guided;
        EXPECT_GT(lamps, 1000);
    }
}

TEST_F(ReuseTest, AShadowAndAMirrorFollowAChangeFarFromThem) {
    // Left of the mirror of metal lies a floor. A post is put up that throws its shadow there; the wall that
    // the mirror shows changes its colour. Neither lies in a brick that changed. Or sand falls, and with it
    // its shadow, of which fewer paths tell.
    Scene scene = plain_scene(R"({"size": [32, 24, 32],
        "camera": {"position_vox": [12, 22, 24], "pitch_deg": -60, "fov_deg": 50},
        "sun": {"azimuth_deg": 150, "elevation_deg": 35, "irradiance": [8, 8, 8], "angular_radius_deg": 0},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"metal": {"base_color": [1, 1, 1], "roughness": 0, "metallic": 1},
                      "dirt": {"base_color": [0.02, 0.02, 0.02]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [32, 1, 32], "material": "wall"}},
                  {"box": {"min": [12, 0, 8], "max": [32, 1, 24], "material": "metal"}},
                  {"box": {"min": [0, 0, 0], "max": [32, 20, 2], "material": "wall"}}]})");
    scene.settings.max_bounces = 2;
    scene.settings.light_sampling = LightSampling::Lights;
    scene.settings.history = History::Count;
    scene.settings.history_cap = 100;
    const glm::ivec2 size(65, 47);
    const auto make = [&](bool falls, bool retrace) {
        scene.settings.retrace_changes = retrace;
        auto studio = std::make_unique<Studio>(scene);
        if (falls) put(*studio, {6, 16, 27}, 2, MATERIAL_SAND);
        return studio;
    };
    const auto change = [](Studio& studio, bool falls) {
        if (falls) {
            studio.simulation.step(6, studio.settings());
        } else {
            put(studio, {6, 10, 27}, 1, MATERIAL_STONE);
            put(studio, {18, 12, 1}, 4, MATERIAL_DIRT);
        }
    };
    for (const bool falls : {false, true}) {
        const auto fresh = make(falls, false);
        change(*fresh, falls);
        const Picture after = fresh->shoot(size);
        double errors[2];
        for (const bool retrace : {false, true}) {
            const auto studio = make(falls, retrace);
            for (int frame = 0; frame < 40; ++frame) studio->shoot(size);
            change(*studio, falls);
            Picture picture;
            for (int frame = 0; frame < 4; ++frame) picture = studio->shoot(size);
            errors[retrace] = relative_error(picture, after);
        }
        // What is left lies at the shadow's edge, where some of the retraced paths saw no change.
        EXPECT_LT(errors[1], 0.2 * errors[0]) << falls;
        EXPECT_GT(errors[0], 1e-3) << falls;
    }
}

TEST_F(ReuseTest, APixelThatTheLastFrameDidNotShowTakesMorePaths) {
    const glm::ivec2 size(48, 48);
    Scene scene = noisy_floor();
    scene.settings.low_discrepancy = false;
    const Picture mean = picture_of(scene, 3000, size, [](Settings& s) { s.max_bounces = 1; });
    scene.settings.history = History::Count;
    // Of the first and of the second frame.
    std::array<double, 2> errors[2];
    for (const bool more : {false, true}) {
        scene.settings.new_pixel_samples = more ? 4 : 1;
        Studio studio(scene);
        Studio counts(scene);
        counts.settings().view = ViewKind::History;
        for (int frame = 0; frame < 2; ++frame) {
            errors[more][frame] = relative_error(studio.shoot(size), mean);
            for (const float kept : counts.shoot(size).image.pixels) ASSERT_EQ(kept, (more ? 4 : 1) + frame);
        }
    }
    // Errors of 2304 pixels: their ratios spread by some 5 %.
    EXPECT_NEAR(errors[0][0] / errors[1][0], 4, 0.8);
    EXPECT_NEAR(errors[0][0] / errors[1][1], 5, 1.0);
    EXPECT_NEAR(errors[0][0] / errors[0][1], 2, 0.4);
}

// A niche under a sky, whose light bounces often.
Scene niche() {
    return scene_from(R"({"size": [16, 12, 16],
        "camera": {"position_vox": [8, 6, 15], "pitch_deg": -15, "fov_deg": 70},
        "sun": {"azimuth_deg": 200, "elevation_deg": 50, "irradiance": [3, 3, 3], "angular_radius_deg": 2},
        "build": [{"box": {"min": [0, 0, 0], "max": [16, 12, 2], "material": "wall"}},
                  {"box": {"min": [0, 0, 0], "max": [2, 12, 16], "material": "wall"}},
                  {"box": {"min": [14, 0, 0], "max": [16, 12, 16], "material": "dirt"}},
                  {"box": {"min": [0, 0, 0], "max": [16, 1, 16], "material": "wall"}},
                  {"box": {"min": [5, 1, 4], "max": [8, 5, 7], "material": "stone"}}]})");
}

TEST_F(ReuseTest, APictureAtRestNeverGetsWorseAndEndsAtTheExactMean) {
    const glm::ivec2 size(24, 16);
    const Picture exact = picture_of(niche(), 4000, size);
    for (const Quality quality : {Quality::Fast, Quality::Balanced}) {
        // Means of a few pictures: one may err by chance.
        constexpr int pictures = 2;
        std::map<int, double> errors;
        for (int i = 0; i < pictures; ++i) {
            Studio studio(niche());
            apply_quality(studio.settings(), quality);
            studio.renderer.set_frame_index(1000000u * (i + 1));
            for (int frame = 1; frame <= 1024; ++frame) {
                const bool looked_at = frame >= 32 && (frame & (frame - 1)) == 0;
                if (looked_at)
                    errors[frame] += relative_error(studio.shoot(size), exact) / pictures;
                else
                    studio.renderer.render(studio.simulation, studio.settings(), size);
            }
            EXPECT_GT(studio.renderer.samples(), 200u);
        }
        double least = INFINITY;
        for (const auto& [frame, error] : errors) {
            EXPECT_LT(error, 1.05 * least) << frame;
            least = std::min(least, error);
        }
        EXPECT_LT(least, 0.1 * errors[32]);
    }
}

TEST_F(ReuseTest, RestEndsWithAMoveAnEditOrAnotherViewAndCanBeSwitchedOff) {
    const glm::ivec2 size(16, 12);
    Studio studio(niche());
    apply_quality(studio.settings(), Quality::Fast);
    const auto rest = [&] {
        for (int frame = 0; frame < 120; ++frame)
            studio.renderer.render(studio.simulation, studio.settings(), size);
        return studio.renderer.samples();
    };
    const auto kept_after = [&] {
        studio.renderer.render(studio.simulation, studio.settings(), size);
        return studio.renderer.samples();
    };
    // 120 frames, 32 of them the preset's, four to a sample.
    EXPECT_NEAR(static_cast<double>(rest()), 22, 2);
    studio.settings().camera_yaw_deg = 1;
    EXPECT_EQ(kept_after(), 32u);
    EXPECT_NEAR(static_cast<double>(rest()), 22, 2);
    put(studio, {10, 3, 5}, 1, MATERIAL_STONE);
    EXPECT_EQ(kept_after(), 32u);
    EXPECT_NEAR(static_cast<double>(rest()), 22, 2);
    studio.simulation.step(1, studio.settings());  // moves nothing
    EXPECT_NEAR(static_cast<double>(kept_after()), 22, 2);
    studio.settings().view = ViewKind::Depth;
    EXPECT_EQ(kept_after(), 32u);
    studio.settings().view = ViewKind::Picture;
    studio.settings().refine_at_rest = false;
    EXPECT_EQ(rest(), 32u);
}

TEST_F(ReuseTest, ASurfaceIsWhatItsCodeSays) {
    struct Result {
        std::uint32_t cases = 0, wrong_code = 0, wrong_point = 0, wrong_still = 0, wrong_moving = 0;
    } result;
    const gl::Program program({.label = "surface code",
                               .compute = "tests/kernels/surface_code.comp",
                               .vertex = {},
                               .fragment = {},
                               .defines = {}});
    gl::Buffer buffer("result", sizeof(Result));
    buffer.upload(std::span<const Result>(&result, 1));
    buffer.bind_storage(0);
    // Planes up to 1024 voxels, six faces, all ids but the sky's.
    program.dispatch({257, 6, 255});
    buffer.download(std::span(&result, 1));
    EXPECT_EQ(result.cases, 257u * 64 * 6 * 255);
    EXPECT_EQ(result.wrong_code, 0u);
    EXPECT_EQ(result.wrong_point, 0u);
    EXPECT_EQ(result.wrong_still, 0u);
    EXPECT_EQ(result.wrong_moving, 0u);
}

// Water that may move has a filter of its own.
TEST_F(ReuseTest, TheFilterOfMovingWaterIsTheSameForAllElse) {
    Scene scene = noisy_floor();
    for (const glm::ivec3 cell : {glm::ivec3(1, 0, 1), glm::ivec3(2, 0, 1)})
        scene.cells.at(cell) = MATERIAL_WATER_FULL;  // below the floor's top, out of sight
    apply_quality(scene.settings, Quality::Balanced);
    scene.settings.refine_at_rest = scene.settings.retrace_changes = false;
    Studio still(scene);
    Studio moving(scene);
    for (int frame = 0; frame < 6; ++frame) {
        put(moving, {30, 0, 30}, 0, frame % 2 == 0 ? MATERIAL_STONE : MATERIAL_DIRT);
        EXPECT_EQ(still.shoot({32, 32}).image.pixels, moving.shoot({32, 32}).image.pixels) << frame;
    }
    EXPECT_GT(moving.simulation.last_change(), still.simulation.last_change());
}

}  // namespace
}  // namespace tarn
