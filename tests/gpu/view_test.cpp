// The views against what their scenes are known to show.
#include <map>
#include <set>

#include "app/camera.h"
#include "shared/trace.h"
#include "shared/views.h"
#include "studio.h"

namespace tarn {
namespace {

class ViewTest : public GlTest {};

constexpr ViewKind all_views[] = {ViewKind::Albedo,  ViewKind::Normal, ViewKind::Depth,   ViewKind::Material,
                                  ViewKind::Bounces, ViewKind::Steps,  ViewKind::History, ViewKind::Variance};

Picture view_of(Studio& studio, ViewKind view, glm::ivec2 size_px) {
    studio.settings().view = view;
    return studio.shoot(size_px);
}

// A slab of grass and a pool of water side by side under the sky, and between them a wall's end.
Scene shore() {
    return plain_scene(R"({"size": [32, 16, 32],
        "camera": {"position_vox": [16.25, 8.5, 30.25], "pitch_deg": -20, "yaw_deg": 7, "fov_deg": 70},
        "build": [{"box": {"min": [0, 0, 0], "max": [16, 3, 32], "material": "grass"}},
                  {"box": {"min": [16, 0, 0], "max": [32, 4, 32], "material": "water"}},
                  {"box": {"min": [12, 0, 4], "max": [20, 9, 6], "material": "wall"}}]})");
}

// The first surface of `shore` along a ray from its eye, by the planes of its boxes.
struct Seen {
    double depth_vox = INFINITY;
    glm::vec3 normal{0};
    std::uint8_t material = SURFACE_SKY;
    bool on_edge = false;  // so near that rounding decides
};
Seen seen_on_shore(glm::dvec3 eye, glm::dvec3 dir) {
    struct Box {
        glm::dvec3 min, max;
        std::uint8_t material;
    };
    Seen seen;
    for (const Box& box :
         {Box{{0, 0, 0}, {16, 3, 32}, MATERIAL_GRASS}, Box{{16, 0, 0}, {32, 4, 32}, MATERIAL_WATER},
          Box{{12, 0, 4}, {20, 9, 6}, MATERIAL_WALL}}) {
        for (int axis = 0; axis < 3; ++axis) {
            const double plane = dir[axis] < 0 ? box.max[axis] : box.min[axis];
            const double t = (plane - eye[axis]) / dir[axis];
            if (!(t > 0 && t < seen.depth_vox + 1e-3)) continue;
            const glm::dvec3 point = eye + t * dir;
            double margin = INFINITY;
            for (int other = 0; other < 3; ++other)
                if (other != axis)
                    margin = std::min({margin, point[other] - box.min[other], box.max[other] - point[other]});
            if (margin < -1e-3) continue;
            if (std::abs(margin) <= 1e-3 || std::abs(t - seen.depth_vox) <= 1e-3) seen.on_edge = true;
            if (margin <= 0 || t >= seen.depth_vox) continue;
            glm::vec3 normal(0);
            normal[axis] = dir[axis] < 0 ? 1 : -1;
            seen = {t, normal, box.material, seen.on_edge};
        }
    }
    return seen;
}

TEST_F(ViewTest, TheFirstSurfaceIsWhereTheSceneHasIt) {
    Studio studio(shore());
    const glm::ivec2 size(61, 47);
    const Picture albedo = view_of(studio, ViewKind::Albedo, size);
    const Picture normal = view_of(studio, ViewKind::Normal, size);
    const Picture depth = view_of(studio, ViewKind::Depth, size);
    const Picture material = view_of(studio, ViewKind::Material, size);
    const View view(studio.scene.settings, size);
    std::map<int, int> pixels_of;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec3 dir(view.dir_through(glm::vec2(x, y) + 0.5f));
            const Seen seen = seen_on_shore(view.eye_vox(), dir);
            if (seen.on_edge) continue;
            SCOPED_TRACE(fmt::format("{}, {}", x, y));
            ++pixels_of[seen.material];
            EXPECT_EQ(material.at(x, y), glm::dvec3(seen.material));
            EXPECT_EQ(normal.at(x, y), glm::dvec3(seen.normal));
            if (seen.material == SURFACE_SKY) {
                EXPECT_EQ(albedo.at(x, y), glm::dvec3(0));
                EXPECT_EQ(depth.at(x, y), glm::dvec3(VIEW_NOTHING));
                continue;
            }
            EXPECT_EQ(albedo.at(x, y), glm::dvec3(studio.scene.materials[seen.material].base_color));
            // float32: some roundings of the direction and the distance, each 6e-8 of it.
            EXPECT_NEAR(depth.at(x, y).x, seen.depth_vox, 1e-6 * seen.depth_vox);
        }
    }
    for (const std::uint8_t id : {MATERIAL_GRASS, MATERIAL_WATER, MATERIAL_WALL, std::uint8_t{SURFACE_SKY}})
        EXPECT_GT(pixels_of[id], 50) << int{id};
}

TEST_F(ViewTest, AClosedMirrorBouncesAsOftenAsItMay) {
    Scene scene = plain_scene(R"({"size": [12, 12, 12], "camera": {"position_vox": [6, 6, 6], "yaw_deg": 20},
        "materials": {"metal": {"base_color": [1, 1, 1], "roughness": 0, "metallic": 1}},
        "build": [{"box": {"min": [0, 0, 0], "max": [12, 12, 12], "material": "metal"}},
                  {"box": {"min": [1, 1, 1], "max": [11, 11, 11], "material": "air"}}]})");
    scene.settings.roulette_after = 1024;
    scene.settings.samples_per_pixel = 4;
    Studio studio(scene);
    for (const int bounces : {0, 1, 7, 50}) {
        studio.settings().max_bounces = bounces;
        EXPECT_EQ(view_of(studio, ViewKind::Bounces, {16, 16}).worst(bounces), 0) << bounces;
    }
}

TEST_F(ViewTest, AnOpenCorridorOfMirrorsBouncesUntilTheRayLeaves) {
    // Mirrors at z = 1 and z = 11; the corridor ends with the world at x = 64.
    Scene scene = plain_scene(R"({"size": [64, 128, 12],
        "camera": {"position_vox": [2, 64, 6], "yaw_deg": 40, "fov_deg": 3},
        "materials": {"metal": {"base_color": [1, 1, 1], "roughness": 0, "metallic": 1}},
        "build": [{"box": {"min": [0, 0, 0], "max": [64, 128, 1], "material": "metal"}},
                  {"box": {"min": [0, 0, 11], "max": [64, 128, 12], "material": "metal"}}]})");
    scene.settings.roulette_after = 1024;
    Studio studio(scene);
    const glm::ivec2 size(64, 8);
    const Picture picture = view_of(studio, ViewKind::Bounces, size);
    const View view(scene.settings, size);
    std::set<int> counts;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec3 dir(view.dir_through(glm::vec2(x, y) + 0.5f));
            // Unfolded, the mirrors are planes 10 apart, the first 5 away.
            const double crossings = (-dir.z / dir.x * 62 - 5) / 10 + 1;
            if (std::abs(crossings - std::round(crossings)) < 1e-3) continue;
            EXPECT_EQ(picture.at(x, y).x, std::floor(crossings)) << x << ", " << y;
            counts.insert(static_cast<int>(crossings));
        }
    }
    EXPECT_GE(counts.size(), 4u);
}

TEST_F(ViewTest, StepsOfARayAlongAnAxisAreTheVoxelsItEnters) {
    Scene scene = plain_scene(R"({"size": [16, 16, 64], "camera": {"position_vox": [8.5, 8.5, 8.5]},
        "build": [{"box": {"min": [0, 0, 0], "max": [16, 16, 5], "material": "wall"}}]})");
    scene.settings.max_bounces = 0;
    scene.settings.traversal = Traversal::Voxel;
    Studio studio(scene);
    for (const int cell : {5, 6, 20, 63}) {
        studio.settings().camera_position_vox.z = static_cast<float>(cell) + 0.5f;
        studio.settings().camera_yaw_deg = 0;
        EXPECT_EQ(view_of(studio, ViewKind::Steps, {1, 1}).at(0, 0).x, cell - 4) << "to the wall";
        studio.settings().camera_yaw_deg = 180;
        EXPECT_EQ(view_of(studio, ViewKind::Steps, {1, 1}).at(0, 0).x, 64 - cell) << "out of the world";
    }
    studio.settings().camera_yaw_deg = 0;
    studio.settings().camera_position_vox.z = 200;
    EXPECT_EQ(view_of(studio, ViewKind::Steps, {1, 1}).at(0, 0).x, 60) << "from outside, the face included";
    studio.settings().camera_yaw_deg = 180;
    EXPECT_EQ(view_of(studio, ViewKind::Steps, {1, 1}).at(0, 0).x, 0) << "past the world";
    studio.settings().camera_position_vox.z = 63.5;
    studio.settings().camera_yaw_deg = 0;
    studio.settings().traversal = Traversal::Distance;
    EXPECT_LT(view_of(studio, ViewKind::Steps, {1, 1}).at(0, 0).x, 20) << "skipping";
}

TEST_F(ViewTest, RaysToTheSunCountAmongTheSteps) {
    // Down to a black floor from the cell 12 over it; then up to a sun at the zenith.
    Scene scene = plain_scene(R"({"size": [16, 16, 16],
        "camera": {"position_vox": [8.5, 12.5, 8.5], "pitch_deg": -90},
        "sun": {"elevation_deg": 90, "angular_radius_deg": 0},
        "build": [{"box": {"min": [0, 0, 0], "max": [16, 1, 16], "material": "wall"}}]})");
    scene.settings.traversal = Traversal::Voxel;
    scene.settings.max_bounces = 1;
    scene.settings.max_diffuse_bounces = 1;
    const auto steps_with = [&](LightSampling sampling) {
        scene.settings.light_sampling = sampling;
        Studio studio(scene);
        return view_of(studio, ViewKind::Steps, {1, 1}).at(0, 0).x;
    };
    // So dark that roulette ends the path, and yet the sun is asked for.
    scene.materials[MATERIAL_WALL].base_color = glm::vec3(1e-7f);
    scene.settings.roulette_after = 0;
    EXPECT_EQ(steps_with(LightSampling::None), 12);
    EXPECT_EQ(steps_with(LightSampling::Lights), 12 + 15);
    scene.materials[MATERIAL_WALL].base_color = glm::vec3(0);
    EXPECT_EQ(steps_with(LightSampling::Lights), 12) << "not asked for";
}

TEST_F(ViewTest, HistoryCountsFramesAndRestartsAfterAJump) {
    for (const History history : {History::None, History::Blend, History::Count, History::Exact}) {
        Scene scene = noisy_floor();
        scene.settings.history = history;
        scene.settings.history_cap = 6;
        Studio studio(scene);
        const bool capped = history == History::Count || history == History::Blend;
        for (int frame = 1; frame <= 9; ++frame) {
            const double expected = history == History::None ? 1 : capped ? std::min(frame, 6) : frame;
            EXPECT_EQ(view_of(studio, ViewKind::History, {24, 16}).worst(expected), 0) << frame;
        }
        studio.settings().camera_yaw_deg = 90;
        studio.settings().camera_pitch_deg = 90;
        EXPECT_EQ(view_of(studio, ViewKind::History, {24, 16}).worst(1), 0);
        studio.shoot({24, 16});
        studio.renderer.reset_history();
        EXPECT_EQ(view_of(studio, ViewKind::History, {24, 16}).worst(1), 0);
    }
}

TEST_F(ViewTest, ExactVarianceIsThatOfTheFramesOverTheirNumber) {
    const glm::ivec2 size(16, 12);
    Studio single(noisy_floor());
    Studio exact(noisy_floor());
    exact.settings().history = History::Exact;
    exact.settings().view = ViewKind::Variance;
    std::vector<std::vector<double>> values(size.x * size.y);
    for (int frame = 1; frame <= 30; ++frame) {
        const Picture fresh = single.shoot(size);
        const Picture variance = exact.shoot(size);
        if (frame == 1) {
            EXPECT_EQ(variance.worst(VIEW_NOTHING), 0);
        }
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                std::vector<double>& of_pixel = values[x + y * size.x];
                of_pixel.push_back(luminance(fresh.at(x, y)));
                if (frame == 1) continue;
                double mean = 0;
                for (const double value : of_pixel) mean += value / frame;
                double sum = 0;
                for (const double value : of_pixel) sum += (value - mean) * (value - mean);
                const double expected = sum / frame / (frame - 1);
                // Deviations are differences of float32 luminances of 1 or so.
                EXPECT_NEAR(variance.at(x, y).x, expected, 1e-4 * expected + 1e-7) << frame;
            }
        }
    }
}

// What the view foretold over what independent pictures differ by: means over pixels and runs. Each run is
// `frames` frames; the view is asked for from the frame `begin` on.
double foretold_over_found(const Scene& scene, int frames, int begin) {
    constexpr int runs = 64;
    const glm::ivec2 size(16, 12);
    Studio viewed(scene);
    Studio pictured(scene);  // the same frames: random numbers follow from the frame's index
    std::vector<double> sum(size.x * size.y), squares(size.x * size.y);
    double foretold = 0;
    for (int run = 0; run < runs; ++run) {
        for (Studio* studio : {&viewed, &pictured}) studio->renderer.reset_history();
        for (int frame = 0; frame < frames; ++frame) {
            viewed.settings().view = frame < begin ? ViewKind::Picture : ViewKind::Variance;
            for (Studio* studio : {&viewed, &pictured})
                studio->renderer.render(studio->simulation, studio->scene.settings, size);
        }
        foretold += Picture{viewed.renderer.read_radiance()}.mean().x / runs;
        const Picture picture{pictured.renderer.read_radiance()};
        for (int i = 0; i < size.x * size.y; ++i) {
            const double value = luminance(picture.at(i % size.x, i / size.x));
            sum[i] += value;
            squares[i] += value * value;
        }
    }
    double found = 0;
    for (int i = 0; i < size.x * size.y; ++i)
        found += (squares[i] - sum[i] * sum[i] / runs) / (runs - 1) / (size.x * size.y);
    return foretold / found;
}

TEST_F(ViewTest, VarianceForetellsWhatIndependentPicturesDifferBy) {
    // 64 runs of 192 pixels know their variance to sqrt(2 / 63 / 192) = 1.3 %: three of these and a half.
    constexpr double tolerance = 0.045;
    Scene scene = noisy_floor();
    scene.settings.history_cap = 6;
    scene.settings.history_alpha = 0.3f;
    scene.settings.history = History::Exact;
    EXPECT_NEAR(foretold_over_found(scene, 8, 0), 1, tolerance);
    EXPECT_NEAR(foretold_over_found(scene, 8, 7), 1, tolerance) << "exact mode always knows";
    scene.settings.history = History::Count;
    for (const int frames : {4, 16})
        EXPECT_NEAR(foretold_over_found(scene, frames, 0), 1, tolerance) << frames;
    EXPECT_NEAR(foretold_over_found(scene, 4, 2), 1, tolerance) << "asked for amid the history";
    scene.settings.history = History::Blend;
    for (const int frames : {3, 12})
        EXPECT_NEAR(foretold_over_found(scene, frames, 0), 1, tolerance) << frames;
}

TEST_F(ViewTest, VarianceIsUnknownWithoutHistory) {
    Studio studio(noisy_floor());
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_EQ(view_of(studio, ViewKind::Variance, {8, 8}).worst(VIEW_NOTHING), 0);
    studio.settings().history = History::Count;
    view_of(studio, ViewKind::Variance, {8, 8});
    EXPECT_GT(view_of(studio, ViewKind::Variance, {8, 8}).mean().x, 0);
    studio.settings().history = History::None;
    EXPECT_EQ(view_of(studio, ViewKind::Variance, {8, 8}).worst(VIEW_NOTHING), 0)
        << "nothing is left of before";
}

TEST_F(ViewTest, LookingAtViewsChangesNoBitOfThePicture) {
    for (const History history : {History::None, History::Blend, History::Count, History::Exact}) {
        Scene scene = shore();
        scene.settings.history = history;
        scene.settings.filter = Filter::EdgeAware;
        Studio plain(scene);
        Studio viewed(scene);
        for (const ViewKind view : all_views) {
            plain.shoot({33, 21});
            view_of(viewed, view, {33, 21});
        }
        const Picture expected = plain.shoot({33, 21});
        EXPECT_EQ(view_of(viewed, ViewKind::Picture, {33, 21}).image.pixels, expected.image.pixels);
        EXPECT_EQ(viewed.renderer.samples(), plain.renderer.samples());
    }
}

TEST_F(ViewTest, AnySizeScaleAndHistoryGivesFiniteValues) {
    for (const History history : {History::None, History::Count, History::Exact}) {
        for (const float scale : {1.f, 0.4f}) {
            Scene scene = shore();
            scene.settings.history = history;
            scene.settings.resolution_scale = scale;
            Studio studio(scene);
            for (const ViewKind view : all_views) {
                for (const glm::ivec2 size : {glm::ivec2(1, 1), {37, 11}}) {
                    view_of(studio, view, size);
                    const Picture picture = studio.shoot(size);
                    EXPECT_EQ(glm::ivec2(picture.image.width, picture.image.height), size);
                    EXPECT_TRUE(all_finite(picture));
                    EXPECT_EQ(picture.rejected, 0u);
                }
            }
        }
    }
}

TEST_F(ViewTest, TheColoursOfAPictureAreThoseOfItsValues) {
    Studio studio(shore());
    studio.settings().history = History::Exact;
    const glm::ivec2 size(41, 23);
    studio.shoot(size);
    for (const ViewKind kind : all_views) {
        const auto view = static_cast<int>(kind);
        const Picture values = view_of(studio, kind, size);
        const ImageRgba8 picture = studio.renderer.read_picture();
        std::set<int> seen;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const glm::dvec3 value = values.at(x, y);
                glm::vec3 color(0);
                if (kind == ViewKind::Normal && value != glm::dvec3(0)) color = 0.5 * value + 0.5;
                if (kind == ViewKind::Material && value.x != SURFACE_SKY)
                    color = view_material_color(static_cast<std::uint32_t>(value.x));
                if (kind == ViewKind::Albedo)
                    color =
                        1.055 * glm::pow(value, glm::dvec3(1 / 2.4)) - 0.055;  // no base colour is so dark
                if (kind == ViewKind::Albedo && value == glm::dvec3(0)) color = glm::vec3(0);
                if (view_has_scale(view) && value.x != VIEW_NOTHING) {
                    const double low = view_low(view) + view_offset(view);
                    const double high = view_high(view) + view_offset(view);
                    const double t =
                        std::log(std::max(value.x + view_offset(view), low) / low) / std::log(high / low);
                    color = glm::clamp(view_color(static_cast<float>(std::clamp(t, 0.0, 1.0))), 0.f, 1.f);
                }
                const std::uint8_t* code = &picture.pixels[4 * (x + std::size_t{1} * y * size.x)];
                // Half a code of rounding, and what float32 leaves of a steep curve.
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(code[c], 255 * color[c], 0.52) << view << " at " << x << ", " << y;
                seen.insert(code[0] + 256 * code[1] + 65536 * code[2]);
            }
        }
        EXPECT_GE(seen.size(), kind == ViewKind::History ? 1u : 3u) << view;
    }
}

TEST_F(ViewTest, TheScaleGrowsBrighterAndNamedMaterialsDiffer) {
    double last = -1;
    for (int i = 0; i <= 256; ++i) {
        const double brightness = luminance(
            glm::pow(glm::clamp(view_color(static_cast<float>(i) / 256), 0.f, 1.f), glm::vec3(2.2f)));
        EXPECT_GE(brightness, last) << i;
        last = brightness;
    }
    EXPECT_GT(last, 0.9);
    for (const std::uint8_t a : named_materials())
        for (const std::uint8_t b : named_materials())
            if (a != b && a != MATERIAL_AIR && b != MATERIAL_AIR) {
                EXPECT_GT(glm::distance(view_material_color(a), view_material_color(b)), 0.15f)
                    << int{a} << " " << int{b};
            }
}

}  // namespace
}  // namespace tarn
