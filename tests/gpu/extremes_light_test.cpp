// Extremes of materials, of the sun and of radiance, against closed forms. extremes_test lists where the
// others are.
#include <numbers>

#include "microfacet_energy.h"
#include "studio.h"

namespace tarn {
namespace {

class ExtremesLightTest : public GlTest {};

constexpr double pi = std::numbers::pi;

// A slab of one material, two voxels thick, under a uniform sky of radiance 1 and over it; seen from above.
Scene slab_of(const std::string& material) {
    Scene scene = plain_scene(R"({"size": [64, 8, 64], "metres_per_voxel": 1,
        "camera": {"position_vox": [32.5, 7, 32.5], "pitch_deg": -90, "fov_deg": 1},
        "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]},
        "materials": {"glass": {"absorption_per_m": [0, 0, 0]}, "metal": {"base_color": [1, 1, 1]},
                      "wall": {"base_color": [1, 1, 1]}},
        "build": [{"box": {"min": [0, 1, 0], "max": [64, 3, 64], "material": ")" +
                              material + R"("}}]})");
    scene.settings.roulette_after = 1024;
    return scene;
}

// Of `frames` frames; with the noise of the mean as `standard_error()`.
Picture mean_of(Scene scene, int frames, glm::ivec2 size) {
    scene.settings.history = History::Exact;
    Studio studio(std::move(scene));
    for (int frame = 1; frame < frames; ++frame)
        studio.renderer.render(studio.simulation, studio.scene.settings, size);
    return studio.shoot(size);
}

constexpr float roughnesses[] = {0, 1e-4f, 1e-3f, 1};
constexpr float indices[] = {1, 1.0001f, 0.75f, 3};

TEST_F(ExtremesLightTest, AWhiteCoatedFloorReflectsAllAtAnyRoughnessAndIndex) {
    for (const float roughness : roughnesses) {
        for (const float index : indices) {
            for (const float pitch_deg : {-90.f, -30.f}) {
                Scene scene = slab_of("wall");
                scene.materials[MATERIAL_WALL].roughness = roughness;
                scene.materials[MATERIAL_WALL].ior = index;
                scene.settings.camera_pitch_deg = pitch_deg;
                const Picture picture = mean_of(scene, 16, {32, 32});
                // The table of albedos is interpolated: half a percent at most, as in light_test.
                EXPECT_NEAR(picture.mean().x, 1, 0.005 + 3 * picture.standard_error())
                    << roughness << " " << index << " " << pitch_deg;
                EXPECT_TRUE(all_finite(picture));
                EXPECT_EQ(picture.rejected, 0u);
            }
        }
    }
}

TEST_F(ExtremesLightTest, AWhiteMetalReflectsAllAtAnyRoughness) {
    for (const float roughness : roughnesses) {
        for (const float pitch_deg : {-90.f, -30.f}) {
            Scene scene = slab_of("metal");
            scene.materials[MATERIAL_METAL].roughness = roughness;
            scene.settings.camera_pitch_deg = pitch_deg;
            const Picture picture = mean_of(scene, 16, {32, 32});
            // The table of albedos is interpolated, as for coats.
            const double tolerance = roughness < 1 ? 1e-6 : 0.005;
            EXPECT_NEAR(picture.mean().x, 1, tolerance + 3 * picture.standard_error())
                << roughness << " " << pitch_deg;
            EXPECT_EQ(picture.rejected, 0u);
        }
    }
}

TEST_F(ExtremesLightTest, ClearGlassLetsAllThroughAtAnyRoughnessAndIndex) {
    for (const float roughness : roughnesses) {
        for (const float index : indices) {
            Scene scene = slab_of("glass");
            scene.materials[MATERIAL_GLASS].roughness = roughness;
            scene.materials[MATERIAL_GLASS].ior = index;
            const Picture picture = mean_of(scene, 16, {32, 32});
            EXPECT_EQ(picture.rejected, 0u);
            EXPECT_TRUE(all_finite(picture));
            if (roughness < 1) {
                // A mirror and an interface: two refractions, each rounded.
                EXPECT_LT(picture.worst(1), 1e-6) << roughness << " " << index;
                continue;
            }
            EXPECT_LE(picture.mean().x, 1 + 3 * picture.standard_error() + 1e-6) << index;
            // Two surfaces, each with the error of the table of rough glass.
            EXPECT_GE(picture.mean().x, 0.99 - 3 * picture.standard_error()) << index;
        }
    }
}

TEST_F(ExtremesLightTest, GlassThatAbsorbsAllReflectsByFresnel) {
    for (const float roughness : {0.f, 1e-4f, 1e-3f}) {
        for (const float index : indices) {
            for (const float pitch_deg : {-90.f, -30.f}) {
                Scene scene = slab_of("glass");
                scene.materials[MATERIAL_GLASS].roughness = roughness;
                scene.materials[MATERIAL_GLASS].ior = index;
                scene.materials[MATERIAL_GLASS].absorption_per_m = glm::vec3(1e4f);
                scene.settings.camera_pitch_deg = pitch_deg;
                const Picture picture = mean_of(scene, 16, {32, 32});
                const double expected = exact_fresnel(std::sin(glm::radians(-double{pitch_deg})), index);
                // The field of view of a degree bends Fresnel's curve by less than this.
                EXPECT_NEAR(picture.mean().x, expected, 4 * picture.standard_error() + 1e-3 * expected + 1e-7)
                    << roughness << " " << index << " " << pitch_deg;
                EXPECT_EQ(picture.rejected, 0u);
            }
        }
    }
}

// A floor under the sun alone, seen straight down.
Scene sunlit_floor(float elevation_deg, float radius_deg) {
    Scene scene = plain_scene(R"({"size": [32, 8, 32], "metres_per_voxel": 1,
        "camera": {"position_vox": [16, 7, 16], "pitch_deg": -90, "fov_deg": 20},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]}, "sun": {"irradiance": [2, 2, 2], "azimuth_deg": 30},
        "materials": {"wall": {"base_color": [0.5, 0.5, 0.5]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [32, 1, 32], "material": "wall"}}]})");
    scene.settings.sun_elevation_deg = elevation_deg;
    scene.settings.sun_angular_radius_deg = radius_deg;
    scene.settings.max_bounces = 1;
    return scene;
}

TEST_F(ExtremesLightTest, APointSunFromTheNadirToTheZenithLightsByItsCosine) {
    for (const float elevation_deg : {-90.f, -1e-3f, 0.f, 1e-3f, 1.f, 89.999f, 90.f}) {
        const Picture picture = mean_of(sunlit_floor(elevation_deg, 0), 1, {8, 8});
        const double cosine = std::max(0.0, std::sin(glm::radians(double{elevation_deg})));
        // float32: the direction's component and some products.
        EXPECT_LT(picture.worst(0.5 / pi * 2 * cosine), 1e-6 * cosine + 1e-12) << elevation_deg;
        EXPECT_EQ(picture.rejected, 0u);
    }
}

TEST_F(ExtremesLightTest, ADiscAtTheZenithAndTheHorizonLightsByItsProjectedSolidAngle) {
    for (const float radius_deg : {0.27f, 5.f, 30.f}) {
        const double a = glm::radians(double{radius_deg});
        const Picture zenith = mean_of(sunlit_floor(90, radius_deg), 64, {16, 16});
        EXPECT_NEAR(zenith.mean().x, 0.5 / pi * 2, 4 * zenith.standard_error() + 1e-5) << radius_deg;
        // Half of the disc: radiance E / (pi sin^2 a) times the integral of the cosine over it, a - sin a cos
        // a.
        const Picture horizon = mean_of(sunlit_floor(0, radius_deg), 256, {16, 16});
        const double part = (a - std::sin(a) * std::cos(a)) / (pi * std::pow(std::sin(a), 2));
        EXPECT_NEAR(horizon.mean().x, 0.5 / pi * 2 * part, 4 * horizon.standard_error()) << radius_deg;
        EXPECT_LT(horizon.standard_error(), 0.02 * horizon.mean().x);
        EXPECT_EQ(zenith.rejected + horizon.rejected, 0u);
    }
}

TEST_F(ExtremesLightTest, TheSunAtTheZenithAndTheHorizonThroughWater) {
    const double n = 1.333;
    for (const float absorption : {0.f, 0.3f, 1e4f}) {
        for (const float elevation_deg : {0.f, 90.f}) {
            Scene scene = sunlit_floor(elevation_deg, 0);
            for (int z = 0; z < 32; ++z)
                for (int x = 0; x < 32; ++x) {
                    const bool rim = x == 0 || z == 0 || x == 31 || z == 31;
                    for (int y = 1; y < 4; ++y)
                        scene.cells.at({x, y, z}) = rim ? MATERIAL_WALL : MATERIAL_WATER_FULL;
                }
            scene.settings.max_bounces = 2;
            scene.settings.max_diffuse_bounces = 1;
            scene.settings.camera_fov_deg = 1;
            scene.materials[MATERIAL_WATER].absorption_per_m = glm::vec3(absorption);
            scene.materials[MATERIAL_WATER].ior = static_cast<float>(n);
            water_settings_from(scene.materials, scene.settings);
            const Picture picture = mean_of(scene, 64, {32, 32});
            // Down through the surface and 3 m of water to the floor, and up again.
            const double passes = 1 - exact_fresnel(1, n);
            const double down = elevation_deg > 0 ? passes * std::exp(-3 * absorption) : 0;
            const double expected = 2 * down * 0.5 / pi * std::exp(-3 * absorption) * passes / (n * n);
            EXPECT_NEAR(picture.mean().x, expected, 4 * picture.standard_error() + 1e-5 * expected)
                << absorption << " " << elevation_deg;
            EXPECT_EQ(picture.rejected, 0u);
        }
    }
}

TEST_F(ExtremesLightTest, RadianceFromAMillionthToAMillionScales) {
    for (const float scale : {1e-6f, 1.f, 1e6f}) {
        // Light from the sky on white, from a point sun, and from walls that shine in a closed box.
        Scene under_sky = slab_of("wall");
        under_sky.settings.sky_zenith = under_sky.settings.sky_horizon = glm::vec3(scale);
        const Picture sky = mean_of(under_sky, 2, {16, 16});
        EXPECT_LT(sky.worst(scale), 1e-6 * scale);
        Scene under_sun = sunlit_floor(30, 0);
        under_sun.settings.sun_irradiance = glm::vec3(scale);
        const Picture sun = mean_of(under_sun, 2, {16, 16});
        EXPECT_LT(sun.worst(0.5 / pi * scale * 0.5), 1e-6 * scale);
        Scene furnace = load_scene("furnace", Settings{});
        plain(furnace.settings);
        furnace.materials[MATERIAL_WALL].emission *= scale;
        furnace.settings.light_sampling = LightSampling::None;
        furnace.settings.roulette_after = 1024;
        furnace.settings.max_bounces = 7;
        const Picture box = mean_of(furnace, 2, {16, 16});
        EXPECT_LT(box.worst(scale * (1 - std::pow(0.5, 8))), 3e-7 * scale);
        // The walls sampled as lights.
        furnace.settings.light_sampling = LightSampling::Lights;
        const Picture sampled = mean_of(furnace, 32, {32, 32});
        EXPECT_NEAR(sampled.mean().x / scale, 1 - std::pow(0.5, 8), 4 * sampled.standard_error() / scale);
        EXPECT_LT(sampled.standard_error(), 0.01 * scale);
        EXPECT_EQ(sky.rejected + sun.rejected + box.rejected + sampled.rejected, 0u);
    }
}

}  // namespace
}  // namespace tarn
