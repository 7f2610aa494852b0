// The clear sky as the shaders have it against its reference in double precision, at every height of the sun.
#include <cmath>

#include "app/frame_block.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "picture.h"
#include "reference/clear_sky.h"
#include "shared/bindings.h"

namespace tarn {
namespace {

class ClearSkyTest : public GlTest {};

struct Sky {
    Settings settings;
    FrameBlock block;

    Sky(float turbidity, float azimuth_deg, float elevation_deg, float radius_deg = 0.27f,
        float brightness = 1) {
        settings.sky_model = SkyModel::Preetham;
        settings.turbidity = turbidity;
        settings.sun_azimuth_deg = azimuth_deg;
        settings.sun_elevation_deg = elevation_deg;
        settings.sun_angular_radius_deg = radius_deg;
        settings.sky_brightness = brightness;
        block = make_frame_block({.settings = settings,
                                  .world_size_vox = {1, 1, 1},
                                  .metres_per_voxel = 1,
                                  .seed = 0,
                                  .frame_index = 0,
                                  .frames_kept = 0,
                                  .traced_px = {1, 1},
                                  .shown_px = {1, 1}});
    }
    ClearSky reference() const {
        return {.turbidity = settings.turbidity,
                .sun_azimuth_deg = settings.sun_azimuth_deg,
                .sun_elevation_deg = settings.sun_elevation_deg,
                .sun_radius_deg = settings.sun_angular_radius_deg,
                .brightness = settings.sky_brightness};
    }
};

// All round, the poles, the axes, rays on and beside the horizon, and beside the sun.
std::vector<glm::vec4> directions(const FrameBlock& block) {
    std::vector<glm::vec4> dirs;
    for (int i = 0; i <= 24; ++i)
        for (int j = 0; j < 24; ++j) {
            const double y = std::cos(std::acos(-1.0) * i / 24);
            const double phi = 2 * std::acos(-1.0) * j / 24;
            const double r = std::sqrt(std::max(0.0, 1 - y * y));
            dirs.emplace_back(r * std::sin(phi), y, -r * std::cos(phi), 0);
        }
    for (const float y : {1e-8f, -1e-8f, 1e-4f, 1e-3f, 2e-3f, 0.f, -0.f}) dirs.emplace_back(0.6f, y, 0.8f, 0);
    for (const float offset : {0.f, 1e-4f, 1e-2f})
        dirs.emplace_back(glm::normalize(glm::vec3(block.sun_dir) + glm::vec3(offset, offset, 0)), 0);
    return dirs;
}

std::vector<glm::vec4> radiance_of(const gl::Program& program, const FrameBlock& block,
                                   const std::vector<glm::vec4>& dirs) {
    gl::Buffer frame("frame block", sizeof(FrameBlock));
    gl::Buffer in("directions", dirs.size() * sizeof(glm::vec4));
    gl::Buffer out("radiance", dirs.size() * sizeof(glm::vec4));
    frame.upload(std::span(&block, 1));
    in.upload(std::span(dirs));
    frame.bind_uniform(BINDING_FRAME);
    in.bind_storage(0);
    out.bind_storage(1);
    program.dispatch_for({static_cast<int>(dirs.size()), 1, 1}, {64, 1, 1});
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<glm::vec4> result(dirs.size());
    out.download(std::span(result));
    return result;
}

TEST_F(ClearSkyTest, IsTheReferencesFromEveryDirectionAtEveryHeightOfTheSun) {
    const gl::Program program({.label = "sky", .compute = "tests/kernels/sky.comp"});
    double worst = 0;
    for (const float turbidity : {2.f, 2.5f, 4.f, 10.f}) {
        for (const float elevation_deg :
             {-90.f, -60.f, -18.f, -6.f, -1.f, -0.27f, -0.1f, 0.f,  0.1f,  0.27f,
              1.f,   5.f,   10.f,  20.f, 30.f, 45.f,   60.f,  75.f, 89.9f, 90.f}) {
            const Sky sky(turbidity, 37 * elevation_deg / 90, elevation_deg);
            const std::vector<glm::vec4> dirs = directions(sky.block);
            const std::vector<glm::vec4> seen = radiance_of(program, sky.block, dirs);
            for (std::size_t i = 0; i < dirs.size(); ++i) {
                const glm::dvec3 expected = clear_sky_radiance(sky.reference(), glm::dvec3(dirs[i]));
                const double scale = std::max({expected.x, expected.y, expected.z});
                for (int c = 0; c < 3; ++c) {
                    ASSERT_TRUE(std::isfinite(seen[i][c]) && seen[i][c] >= 0)
                        << turbidity << " " << elevation_deg << " " << i;
                    worst = std::max(worst, std::abs(seen[i][c] - expected[c]) / scale);
                }
            }
        }
    }
    RecordProperty("worst", fmt::format("{}", worst));
    // Four digits of sRGB's matrix alone are 1.6e-4.
    EXPECT_LT(worst, 2e-4);
}

TEST_F(ClearSkyTest, ItsSunIsTheReferencesForEveryDiscAndBrightness) {
    for (const float turbidity : {2.f, 2.5f, 4.f, 10.f}) {
        for (float elevation_deg = -90; elevation_deg <= 90;
             elevation_deg += elevation_deg < 1 && elevation_deg >= -1 ? 0.05f : 0.5f) {
            for (const float radius_deg : {0.f, 0.27f, 10.f, 90.f}) {
                for (const float brightness : {0.f, 1.f, 1000.f}) {
                    const Sky sky(turbidity, 30, elevation_deg, radius_deg, brightness);
                    const glm::dvec3 sun = clear_sun_irradiance(sky.reference());
                    const double largest = std::max({sun.x, sun.y, sun.z});
                    for (int c = 0; c < 3; ++c) {
                        const float irradiance = sky.block.sun_irradiance[c];
                        const float radiance = sky.block.sun_radiance[c];
                        ASSERT_TRUE(std::isfinite(irradiance) && irradiance >= 0);
                        ASSERT_TRUE(std::isfinite(radiance) && radiance >= 0);
                        // Steps of ten nanometres where the reference has one; sRGB's matrix of four digits.
                        ASSERT_NEAR(irradiance, sun[c], 3e-3 * largest)
                            << turbidity << " " << elevation_deg << " " << radius_deg;
                    }
                    ASSERT_EQ(sky.block.sun_radiance.w, largest > 0 ? 1 : 0);
                }
            }
        }
    }
}

TEST_F(ClearSkyTest, APictureShowsItAndASunThatHasSetLightsNothing) {
    Scene scene = scene_from(R"({"size": [4, 4, 4], "camera": {"position_vox": [2, 2, 30], "pitch_deg": 20},
        "sun": {"azimuth_deg": 100, "elevation_deg": 25}, "sky": {"model": "preetham", "turbidity": 3}})");
    scene.settings.sun_angular_radius_deg = 0;
    for (const float elevation_deg : {25.f, -3.f}) {
        scene.settings.sun_elevation_deg = elevation_deg;
        const Picture picture = picture_of(scene, 1, {9, 9}, [](Settings& s) { s.jitter = false; });
        const glm::dvec3 expected = clear_sky_radiance(
            {.turbidity = 3, .sun_azimuth_deg = 100, .sun_elevation_deg = elevation_deg},
            {0, std::sin(20 * std::acos(-1.0) / 180), -std::cos(20 * std::acos(-1.0) / 180)});
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(picture.at(4, 4)[c], expected[c], 5e-4 * expected.z) << elevation_deg;
    }
    // A floor under a roof far wider than the world's height sees a little sky and no sun either way; in the
    // open the sun adds light by day alone.
    Scene floor = scene_from(R"({"size": [8, 2, 8], "camera": {"position_vox": [4, 1.9, 4], "pitch_deg": -90,
        "fov_deg": 10}, "sun": {"elevation_deg": 40}, "sky": {"model": "preetham"},
        "materials": {"wall": {"base_color": [1, 1, 1], "ior": 1}},
        "build": [{"box": {"min": [0, 0, 0], "max": [8, 1, 8], "material": "wall"}}]})");
    for (const float elevation_deg : {40.f, -5.f}) {
        floor.settings.sun_elevation_deg = elevation_deg;
        const Picture picture = picture_of(floor, 64, {32, 32}, [](Settings& s) { s.max_bounces = 1; });
        const ClearSky sky{.sun_elevation_deg = elevation_deg};
        glm::dvec3 expected(0);
        constexpr int n = 200;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < 2 * n; ++j) {
                const double u = (i + 0.5) / n;
                const double phi = std::acos(-1.0) * (j + 0.5) / n;
                expected += clear_sky_radiance(
                    sky, {std::sqrt(u) * std::sin(phi), std::sqrt(1 - u), -std::sqrt(u) * std::cos(phi)});
            }
        expected /= 2.0 * n * n;
        if (elevation_deg > 0)
            expected +=
                clear_sun_irradiance(sky) * std::sin(elevation_deg * std::acos(-1.0) / 180) / std::acos(-1.0);
        const double tolerance = std::min(4 * picture.standard_error(), 0.01 * expected.x);
        EXPECT_NEAR(picture.mean().x, expected.x, tolerance) << elevation_deg;
        EXPECT_EQ(picture.rejected, 0u);
    }
}

}  // namespace
}  // namespace tarn
