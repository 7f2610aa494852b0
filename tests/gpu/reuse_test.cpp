// What earlier frames and neighbours are worth: fewer traced pixels than shown ones, changes of light that
// the cells of what is seen do not tell of, pictures at rest.
#include <map>
#include <numeric>
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

// mean((x - ref)^2 / (ref^2 + 0.01 mean(ref)^2)) over the pixels that are `counted`; empty: all.
double relative_error(const Picture& picture, const Picture& reference,
                      const std::vector<char>& counted = {}) {
    double mean = 0;
    for (const float p : reference.image.pixels) mean += p;
    mean /= static_cast<double>(reference.image.pixels.size());
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
        if (!counted.empty() && counted[i / 3] == 0) continue;
        const double expected = reference.image.pixels[i];
        sum += std::pow(picture.image.pixels[i] - expected, 2) / (expected * expected + 0.01 * mean * mean);
        ++count;
    }
    return sum / count;
}

void put(Studio& studio, glm::ivec3 center_vox, int radius_vox, std::uint8_t material) {
    EditHistory edits;
    edits.begin_stroke();
    studio.simulation.apply({.shape = BrushShape::Cube,
                             .center_vox = center_vox,
                             .radius_vox = radius_vox,
                             .material = material,
                             .overwrite = true},
                            edits);
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
    // the mirror shows changes its colour. Neither lies in a brick that changed.
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
    const glm::ivec2 size(64, 48);
    const auto changed_world = [](Studio& studio) {
        put(studio, {6, 10, 27}, 1, MATERIAL_STONE);
        put(studio, {18, 12, 1}, 4, MATERIAL_DIRT);
    };
    Studio fresh(scene);
    changed_world(fresh);
    const Picture after = fresh.shoot(size);
    double errors[2];
    for (const bool retrace : {false, true}) {
        scene.settings.retrace_changes = retrace;
        Studio studio(scene);
        for (int frame = 0; frame < 40; ++frame) studio.shoot(size);
        changed_world(studio);
        Picture picture;
        for (int frame = 0; frame < 4; ++frame) picture = studio.shoot(size);
        errors[retrace] = relative_error(picture, after);
    }
    // What is left lies at the shadow's edge, where some of the retraced paths saw no change.
    EXPECT_LT(errors[1], 0.2 * errors[0]);
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

// The bar for ghosts: where the picture changed, the error is soon within 1.5 times of what it is in the long
// run, or of what a picture begun anew has, which has noise as all young pictures do but no ghost. Prints
// after how many frames, for each. Errors are means over takes of the same frames that differ in their random
// numbers: of one take, of a few hundred pixels, chance decides.
class Ghosts : public ReuseTest {
  protected:
    // Of much smaller ones the block's shadow is a few pixels wide, fewer than retracing resolves, and lags.
    static constexpr glm::ivec2 size{240, 135};
    static constexpr int frames_of_steady = 50, frames_of_mean = 10;  // the last of them
    static constexpr int frames_allowed = 10, frames_of_noise_allowed = 25;
    static constexpr int takes_of_a_frame = 2;

    Studio studio{balanced("waterfall")};
    using Takes = std::vector<std::unique_ptr<Renderer>>;
    Takes takes, anew;

    Ghosts() {
        for (int i = 0; i < takes_of_a_frame; ++i)
            for (Takes* some : {&takes, &anew}) {
                some->push_back(std::make_unique<Renderer>(studio.scene, studio.timers));
                some->back()->set_frame_index(std::uint64_t{1024} * i);
            }
    }
    void shoot(const Takes& some) {
        for (const auto& take : some) take->render(studio.simulation, studio.settings(), size);
    }
    double error_of_next(const Takes& some, const Picture& expected, const std::vector<char>& changed) {
        shoot(some);
        double sum = 0;
        for (const auto& take : some) sum += relative_error({take->read_radiance(), 0}, expected, changed);
        return sum / takes_of_a_frame;
    }

    static Scene balanced(const char* name) {
        Settings settings;
        apply_quality(settings, Quality::Balanced);
        settings.refine_at_rest = false;
        return load_scene(name, settings);
    }
    Picture truth() {
        Settings exact = studio.settings();
        apply_quality(exact, Quality::Exact);
        // As the preset draws them: what differs for good says nothing of ghosts.
        exact.caustics = false;
        exact.smooth_water = exact.straight_sunlight = true;
        exact.firefly_limit = studio.settings().firefly_limit;
        Renderer reference(studio.scene, studio.timers);
        for (int frame = 0; frame < 100; ++frame) reference.render(studio.simulation, exact, size);
        return {reference.read_radiance(), 0};
    }
    // Pixels of which a channel differs by more than a tenth and more than their noise.
    static std::vector<char> differing(const Picture& a, const Picture& b) {
        std::vector<char> differs(a.image.pixels.size() / 3, 0);
        for (std::size_t i = 0; i < a.image.pixels.size(); ++i) {
            const float larger = std::max(a.image.pixels[i], b.image.pixels[i]);
            if (std::abs(a.image.pixels[i] - b.image.pixels[i]) > 0.1f * larger + 0.05f) differs[i / 3] = 1;
        }
        return differs;
    }
    void expect_no_ghost_of(const char* what, const Picture& before) {
        const Picture expected = truth();
        const std::vector<char> changed = differing(before, expected);
        const auto pixels = std::ranges::count(changed, 1);
        ASSERT_GT(pixels, 40) << what;
        const double ghost = relative_error(before, expected, changed);
        std::vector<double> errors(frames_of_steady);
        for (double& error : errors) error = error_of_next(takes, expected, changed);
        for (const auto& take : anew) take->reset_history();
        std::vector<double> errors_anew(frames_allowed);
        for (double& error : errors_anew) error = error_of_next(anew, expected, changed);
        const double steady =
            std::accumulate(errors.end() - frames_of_mean, errors.end(), 0.0) / frames_of_mean;
        const double bar = 1.5 * steady;
        const auto frames =
            std::ranges::find_if(errors, [&](double e) { return e <= bar; }) - errors.begin() + 1;
        int frames_of_ghost = 1;
        while (frames_of_ghost <= frames_allowed &&
               errors[frames_of_ghost - 1] > std::max(bar, 1.5 * errors_anew[frames_of_ghost - 1]))
            ++frames_of_ghost;
        fmt::print(
            "{}: of {} pixels that changed, error {:.3f} as before, {:.3f} in the first frame, {:.3f} in the "
            "long run, within 1.5 times from frame {}, of a picture begun anew from frame {}\n",
            what, pixels, ghost, errors.front(), steady, frames, frames_of_ghost);
        EXPECT_LE(frames_of_ghost, frames_allowed) << what;
        EXPECT_LE(frames, frames_of_noise_allowed) << what;
        // Else a ghost that stays would pass.
        EXPECT_GT(ghost, 3 * steady) << what;
    }
};

TEST_F(Ghosts, AreGoneSoonAfterAStopAnEditAndAJump) {
    const auto flow = [&](int frames) {
        for (int frame = 0; frame < frames; ++frame) {
            studio.simulation.step(1, studio.settings());
            shoot(takes);
        }
    };
    studio.simulation.step(40, studio.settings());
    flow(17);
    Picture before = truth();
    flow(3);
    expect_no_ghost_of("a waterfall that stops", before);
    before = truth();
    put(studio, {48, 30, 60}, 4, MATERIAL_STONE);
    expect_no_ghost_of("a block put up", before);
    before = truth();
    put(studio, {48, 30, 60}, 4, MATERIAL_AIR);
    expect_no_ghost_of("a block taken away", before);
    before = truth();
    studio.settings().camera_position_vox += glm::vec3(20, 5, -15);
    studio.settings().camera_yaw_deg -= 25;
    expect_no_ghost_of("a jump of the eye", before);
}

}  // namespace
}  // namespace tarn
