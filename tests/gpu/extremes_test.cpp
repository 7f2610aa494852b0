// Extremes of eyes, worlds, views and pictures: nothing that is not finite, no sample rejected, and an error
// bounded by an answer in closed form. A white world under a uniform sky of radiance 1 is 1 wherever one
// looks.
//
// Where the other extremes are tested:
// - directions with zero components of either sign, origins on faces, edges and corners: traversal_test, a
// million rays
//   bit for bit against the CPU, of which every second is such a one; here as pictures
// - materials, absorption, the sun, radiance: extremes_light_test
// - a million frames, counters at their end, what is not finite in history: extremes_history_test
// - worlds of one row, full ones, odd ones, as the simulation steps them: water_test; too large for the
// driver:
//   bricks_test
// - pictures of 1x1 and 16384x1 in every quality: picture_test; beyond that, `--size` is refused:
// cli.bad_input
// - a minimised window and one of a single pixel: ui.play
// - times of 0 and of 10 s between frames: tick_clock_test, camera_test, app_test
#include "app/camera.h"
#include "shared/trace.h"
#include "shared/views.h"
#include "studio.h"

namespace tarn {
namespace {

class ExtremesTest : public GlTest {};

// White, under a uniform sky of radiance 1.
Scene white_scene(const std::string& size, const std::string& build) {
    Scene scene = plain_scene(R"({"size": )" + size + R"(, "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]},
        "materials": {"wall": {"base_color": [1, 1, 1]}, "water": {"absorption_per_m": [0, 0, 0]}},
        "build": [)" + build + "]}");
    scene.settings.roulette_after = 1024;
    return scene;
}

// The cell that a ray starts in: on a plane, the lower one where that component is negative. Nothing where
// the ray runs so nearly in a plane that rounding decides.
std::optional<glm::ivec3> start_cell(glm::vec3 eye, glm::vec3 dir) {
    glm::ivec3 cell(glm::floor(eye));
    for (int axis = 0; axis < 3; ++axis) {
        if (eye[axis] != std::floor(eye[axis])) continue;
        if (std::abs(dir[axis]) < 1e-5f) return std::nullopt;
        if (dir[axis] < 0) --cell[axis];
    }
    return cell;
}

TEST_F(ExtremesTest, EyesOnFacesEdgesAndCornersSeeTheSkyOrAreInsideASolid) {
    Studio studio(
        white_scene("[8, 8, 8]", R"({"box": {"min": [2, 2, 2], "max": [6, 6, 6], "material": "wall"}})"));
    studio.settings().camera_fov_deg = 90;
    const glm::ivec2 size(9, 9);
    std::uint64_t dark = 0, bright = 0;
    for (const glm::vec3 eye : {glm::vec3(2, 4.5f, 4.5f),
                                {6, 4.5f, 4.5f},
                                {4.5f, 6, 4.5f},
                                {2, 2, 4.5f},
                                {6, 6, 4.5f},
                                {2, 6, 2},
                                {6, 6, 6},
                                {6, 2, 6},
                                {4.5f, 4.5f, 4.5f},
                                {4, 4, 4},
                                {1, 1, 1},
                                {0, 4.5f, 4.5f},
                                {8, 4.5f, 4.5f},
                                {0, 0, 0},
                                {8, 8, 8},
                                {8, 0, 4},
                                {4.5f, 8, 4.5f}}) {
        studio.settings().camera_position_vox = eye;
        for (const float yaw_deg : {0.f, 45.f, 90.f, 180.f, 270.f}) {
            for (const float pitch_deg : {0.f, -90.f, 90.f, -45.f}) {
                studio.settings().camera_yaw_deg = yaw_deg;
                studio.settings().camera_pitch_deg = pitch_deg;
                const Picture picture = studio.shoot(size);
                EXPECT_EQ(picture.rejected, 0u);
                const View view(studio.scene.settings, size);
                for (int y = 0; y < size.y; ++y) {
                    for (int x = 0; x < size.x; ++x) {
                        const auto cell = start_cell(eye, view.dir_through(glm::vec2(x, y) + 0.5f));
                        const bool solid =
                            cell && studio.scene.cells.get(*cell, MATERIAL_AIR) == MATERIAL_WALL;
                        const double found = picture.at(x, y).x;
                        // Whatever rounding decides, it is one or the other.
                        const double expected = cell ? (solid ? 0 : 1) : std::round(found);
                        EXPECT_EQ(found, expected)
                            << fmt::format("eye {} {} {} yaw {} pitch {} at {}, {}", eye.x, eye.y, eye.z,
                                           yaw_deg, pitch_deg, x, y);
                        ++(solid ? dark : bright);
                    }
                }
            }
        }
    }
    EXPECT_GT(dark, 1000u);
    EXPECT_GT(bright, 10000u);
}

TEST_F(ExtremesTest, EyesInAndOnWaterSeeTheSkyByTheIndexSquared) {
    // Water of 3 voxels and nine sixteenths. Looking straight up or down, no ray is caught by total
    // reflection.
    Scene scene =
        white_scene("[8, 8, 8]", R"({"box": {"min": [0, 0, 0], "max": [8, 3, 8], "material": "water"}})");
    for (int z = 0; z < 8; ++z)
        for (int x = 0; x < 8; ++x) scene.cells.at({x, 3, z}) = static_cast<std::uint8_t>(water_cell(9));
    scene.settings.camera_fov_deg = 20;
    Studio studio(scene);
    for (const float index : {0.75f, 1.f, 1.0001f, 1.333f, 3.f}) {
        studio.settings().water_ior = index;
        const double n2 = std::pow(double{index}, 2);
        for (const float height : {0.f, 1.f, 2.5f, 3.f, 3.5f, 3.5625f, 3.75f, 4.f, 8.f, 1e6f}) {
            for (const float pitch_deg : {-90.f, 90.f}) {
                // At the bottom a ray up starts in the water, one down leaves it; at the surface both start
                // in air.
                const bool inside = height < 3.5625f && (height > 0 || pitch_deg > 0);
                const double expected = inside ? n2 : 1;
                studio.settings().camera_position_vox = {4.5f, height, 4.5f};
                studio.settings().camera_pitch_deg = pitch_deg;
                const Picture picture = studio.shoot({9, 9});
                // Some refractions, each rounded.
                EXPECT_LT(picture.worst(expected), 1e-6 * expected)
                    << index << " " << height << " " << pitch_deg;
                EXPECT_EQ(picture.rejected, 0u);
            }
        }
    }
}

TEST_F(ExtremesTest, AMillionVoxelsAwayTheWorldIsWhereItIs) {
    Studio studio(white_scene("[64, 64, 64]",
                              R"({"box": {"min": [0, 0, 0], "max": [64, 64, 60], "material": "wall"}})"));
    studio.settings().camera_fov_deg = 1;
    for (const float distance : {1e4f, 1e6f, 9e6f}) {
        studio.settings().camera_position_vox = {32.5f, 32.5f, 60 + distance};
        EXPECT_LT(studio.shoot({17, 17}).worst(1), 1e-6) << distance;
        studio.settings().view = ViewKind::Depth;
        const double at_eye = double{studio.settings().camera_position_vox.z} - 60;
        EXPECT_NEAR(studio.shoot({1, 1}).at(0, 0).x, at_eye, 2e-7 * at_eye);
        // A pixel beside it looks past the world.
        EXPECT_EQ(studio.shoot({17, 17}).at(0, 0).x, VIEW_NOTHING) << distance;
        studio.settings().view = ViewKind::Picture;
    }
    EXPECT_EQ(studio.renderer.rejected_samples(), 0u);
}

// The depths of a floor whose top is at y = 1, by the eye's rays.
void expect_floor(Studio& studio, glm::ivec2 size, const std::string& what) {
    const Picture picture = studio.shoot(size);
    EXPECT_LT(picture.worst(1), 1e-6) << what;
    EXPECT_EQ(picture.rejected, 0u) << what;
    studio.settings().view = ViewKind::Depth;
    const Picture depth = studio.shoot(size);
    studio.settings().view = ViewKind::Picture;
    const View view(studio.scene.settings, size);
    const glm::vec3 eye = view.eye_vox();
    const glm::dvec3 world(studio.simulation.size_vox());
    int seen = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec3 dir(view.dir_through(glm::vec2(x, y) + 0.5f));
            const double t = (eye.y - 1.0) / -dir.y;
            const glm::dvec3 point = glm::dvec3(eye) + t * dir;
            const double margin = std::min({point.x, point.z, world.x - point.x, world.z - point.z});
            if (!(t > 0) || margin < 0.01) continue;
            // float32: the direction is rounded to 1e-7, which a flat ray enlarges; the hit to its
            // coordinates.
            EXPECT_NEAR(depth.at(x, y).x, t,
                        t * (1e-6 + 2e-7 / std::abs(dir.y)) + 1.2e-7 * std::max(world.x, world.z))
                << what << " at " << x << ", " << y;
            ++seen;
        }
    }
    EXPECT_GT(seen, 0) << what;
}

TEST_F(ExtremesTest, WorldsOfOneVoxelOddFlatAndLargeOnes) {
    for (const glm::ivec3 size : {glm::ivec3(1, 1, 1), {7, 13, 5}, {512, 8, 512}, {512, 512, 512}}) {
        Scene scene = white_scene(
            fmt::format("[{}, {}, {}]", size.x, size.y, size.z),
            fmt::format(R"({{"box": {{"min": [0, 0, 0], "max": [{}, 1, {}], "material": "wall"}}}})", size.x,
                        size.z));
        const glm::vec3 middle(glm::vec3(size) / 2.f);
        scene.settings.camera_position_vox = {middle.x + 0.25f, static_cast<float>(size.y) + 0.5f,
                                              middle.z + 0.125f};
        scene.settings.camera_pitch_deg = -90;
        scene.settings.camera_fov_deg = size.y > 1 ? 40 : 60;
        Studio studio(std::move(scene));
        for (const Traversal traversal : {Traversal::Voxel, Traversal::Distance}) {
            studio.settings().traversal = traversal;
            expect_floor(studio, {11, 7}, fmt::format("{} {} {}", size.x, size.y, size.z));
        }
    }
}

TEST_F(ExtremesTest, FieldsOfViewOf1And179Degrees) {
    Scene scene = white_scene("[256, 16, 256]",
                              R"({"box": {"min": [0, 0, 0], "max": [256, 1, 256], "material": "wall"}})");
    scene.settings.camera_position_vox = {128.25f, 3, 128.125f};
    Studio studio(scene);
    for (const float fov_deg : {1.f, 179.f}) {
        for (const float pitch_deg : {-90.f, -30.f}) {
            studio.settings().camera_fov_deg = fov_deg;
            studio.settings().camera_pitch_deg = pitch_deg;
            expect_floor(studio, {64, 36}, fmt::format("fov {} pitch {}", fov_deg, pitch_deg));
        }
    }
}

TEST_F(ExtremesTest, PicturesOfOnePixelAndOneRowOrColumn) {
    Scene scene =
        white_scene("[64, 16, 64]", R"({"box": {"min": [0, 0, 0], "max": [64, 1, 64], "material": "wall"}})");
    scene.settings.camera_position_vox = {32.25f, 9, 32.125f};
    scene.settings.camera_pitch_deg = -80;
    Studio studio(scene);
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {16384, 1}, {1, 16384}})
        expect_floor(studio, size, fmt::format("{} x {}", size.x, size.y));
}

}  // namespace
}  // namespace tarn
