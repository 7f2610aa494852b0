// Light at smooth interfaces against closed forms: slabs with absorption and all internal bounces, Snell's
// angle and window, the critical angle, radiance under water, glass in water.
#include <numbers>

#include "microfacet_energy.h"
#include "picture.h"

namespace tarn {
namespace {

class WaterLightTest : public GlTest {};

constexpr double degree = std::numbers::pi / 180;

double cos_beyond(double cos_i, double eta) {
    return std::sqrt(1 - (1 - cos_i * cos_i) / (eta * eta));
}

// 4 standard errors of a mean of `n` paths that each return at most `most`.
double four_errors(double most, double n) {
    return 4 * most / (2 * std::sqrt(n));
}

// A slab of glass or water across the world, air above and below, seen from above at `angle_deg` to its
// normal. The sky is `zenith` overhead, `horizon` below.
Picture slab(const char* material, double n, float absorption_per_m, double angle_deg, float zenith,
             float horizon) {
    Scene scene =
        scene_from(R"({"size": [256, 16, 256], "metres_per_voxel": 0.5, "sun": {"irradiance": [0, 0, 0]}})");
    const std::uint8_t id = *material_id(material);
    Material& m = scene.materials[id];
    m.ior = static_cast<float>(n);
    m.absorption_per_m = glm::vec3(absorption_per_m);
    m.roughness = 0;
    for (int z = 0; z < 256; ++z)
        for (int x = 0; x < 256; ++x)
            for (int y = 4; y < 8; ++y)
                scene.cells.at({x, y, z}) = id == MATERIAL_WATER ? MATERIAL_WATER_FULL : id;
    Settings& s = scene.settings;
    if (id == MATERIAL_WATER) {
        s.water_ior = m.ior;
        s.water_color = glm::exp(-m.absorption_per_m);
    }
    s.sky_zenith = glm::vec3(zenith);
    s.sky_horizon = glm::vec3(horizon);
    s.camera_position_vox = {128.5f, 8 + 6 * static_cast<float>(std::cos(angle_deg * degree)),
                             128.5f + 6 * static_cast<float>(std::sin(angle_deg * degree))};
    s.camera_pitch_deg = static_cast<float>(angle_deg - 90);
    s.camera_fov_deg = 1;
    return picture_of(scene, 128, {64, 64});
}

TEST_F(WaterLightTest, ASlabTransmitsAndReflectsAsAllItsInternalBouncesDo) {
    constexpr double paths = 128.0 * 64 * 64;
    for (const auto& [material, n] : {std::pair("water", 1.333), {"glass", 1.5}, {"glass", 2.4}}) {
        for (const float sigma : {0.0f, 0.4f}) {
            for (const double angle_deg : {0.0, 45.0, 70.0}) {
                const double cos_i = std::cos(angle_deg * degree);
                const double f = exact_fresnel(cos_i, n);
                const double a = std::exp(-static_cast<double>(sigma) * 4 * 0.5 / cos_beyond(cos_i, n));
                const double transmitted = (1 - f) * (1 - f) * a / (1 - f * f * a * a);
                const double reflected = f + f * (1 - f) * (1 - f) * a * a / (1 - f * f * a * a);
                // A sky of 1 below and 1 - cos above: reflected light leaves at the angle it came.
                const double expected = transmitted + reflected * (1 - cos_i);
                const double measured = slab(material, n, sigma, angle_deg, 0, 1).mean().x;
                EXPECT_NEAR(measured, expected, four_errors(1, paths))
                    << material << n << " " << sigma << " " << angle_deg;
                if (angle_deg == 0) {
                    EXPECT_NEAR(slab(material, n, sigma, 0, 1, 0).mean().x, reflected,
                                4 * std::sqrt(reflected / paths));
                }
            }
        }
    }
}

// Black ground under a pool; its eye looks straight up.
Scene pool(int depth_vox) {
    Scene scene = scene_from(R"({"size": [192, 24, 192], "sun": {"irradiance": [0, 0, 0]},
        "camera": {"position_vox": [96.5, 3.5, 96.5], "pitch_deg": 90, "fov_deg": 120},
        "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]},
        "materials": {"wall": {"base_color": [0, 0, 0]}, "water": {"absorption_per_m": [0, 0, 0], "ior": 1.333}},
        "build": [{"box": {"min": [0, 0, 0], "max": [192, 1, 192], "material": "wall"}}]})");
    for (int z = 0; z < 192; ++z)
        for (int x = 0; x < 192; ++x)
            for (int y = 1; y <= depth_vox; ++y) scene.cells.at({x, y, z}) = MATERIAL_WATER_FULL;
    return scene;
}

TEST_F(WaterLightTest, SnellsWindowEndsAtTheCriticalAngleAndShowsTheSkyByTheIndexSquared) {
    constexpr int side = 129;
    constexpr int frames = 256;
    const double n = 1.333;
    const Picture picture = picture_of(pool(8), frames, {side, side}, [](Settings& s) { s.jitter = false; });
    EXPECT_EQ(picture.rejected, 0u);
    const double half = std::tan(60 * degree);
    // Rings of pixels of about one angle, by degrees; a pixel counts where its centre lies.
    std::array<double, 90> measured{};
    std::array<double, 90> expected{};
    std::array<int, 90> count{};
    double outside = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double u = (2 * (x + 0.5) / side - 1) * half;
            const double v = (2 * (y + 0.5) / side - 1) * half;
            const double cos_i = 1 / std::sqrt(1 + u * u + v * v);
            const double f = exact_fresnel(cos_i, 1 / n);
            if (f == 1) outside = std::max(outside, picture.at(x, y).x);
            const auto ring = static_cast<std::size_t>(std::acos(cos_i) / degree);
            measured[ring] += picture.at(x, y).x;
            expected[ring] += f == 1 ? 0 : n * n * (1 - f);
            ++count[ring];
        }
    EXPECT_EQ(outside, 0) << "beyond the critical angle the surface mirrors the black ground";
    for (std::size_t ring = 0; ring < 49; ++ring) {
        const double paths = 1.0 * frames * count[ring];
        EXPECT_NEAR(measured[ring] / count[ring], expected[ring] / count[ring], four_errors(n * n, paths))
            << ring;
    }
    EXPECT_GT(count[48], 50);
    EXPECT_GT(count[50], 50);
}

TEST_F(WaterLightTest, RefractedRaysMeetTheBedWhereSnellsLawSays) {
    // The bed shines from x = 100 on; the eye looks down towards +x at each angle, its ray's foot on either
    // side.
    for (const double n : {1.1, 1.333, 2.0}) {
        for (const double angle_deg : {20.0, 50.0, 75.0}) {
            for (const double offset : {-0.02, 0.02}) {
                Scene scene = pool(8);
                for (int z = 0; z < 192; ++z)
                    for (int x = 100; x < 192; ++x) scene.cells.at({x, 0, z}) = MATERIAL_LAMP;
                scene.materials[MATERIAL_LAMP].emission = glm::vec3(1);
                scene.materials[MATERIAL_LAMP].base_color = glm::vec3(0);
                const double sin_t = std::sin(angle_deg * degree) / n;
                const double in_water = 8 * sin_t / std::sqrt(1 - sin_t * sin_t);
                const double in_air = 10 * std::tan(angle_deg * degree);
                Settings& s = scene.settings;
                s.water_ior = static_cast<float>(n);
                s.water_color = glm::vec3(1);
                s.sky_horizon = s.sky_zenith = glm::vec3(0);
                s.camera_position_vox = {static_cast<float>(100 + offset - in_water - in_air), 19, 96.5f};
                s.camera_yaw_deg = 90;
                s.camera_pitch_deg = static_cast<float>(angle_deg - 90);
                const Picture picture = picture_of(scene, 64, {1, 1}, [](Settings& q) {
                    q.jitter = false;
                    q.max_bounces = 1;
                });
                const double shown = (1 - exact_fresnel(std::cos(angle_deg * degree), n)) / (n * n);
                if (offset < 0)
                    EXPECT_EQ(picture.mean().x, 0) << n << " " << angle_deg;
                else
                    EXPECT_NEAR(picture.mean().x, shown, four_errors(1 / (n * n), 64))
                        << n << " " << angle_deg;
            }
        }
    }
}

TEST_F(WaterLightTest, NormalIncidenceReflectsByTheSquareOfTheIndexContrast) {
    for (const auto& [material, n] : {std::pair("water", 1.33), {"glass", 1.5}}) {
        // So dense that nothing comes back from within.
        const Picture picture = slab(material, n, 4, 0, 1, 0);
        const double expected = std::pow((n - 1) / (n + 1), 2);
        EXPECT_NEAR(picture.mean().x, expected, 4 * std::sqrt(expected / (128 * 64 * 64))) << material;
    }
}

TEST_F(WaterLightTest, GlassInWaterIsAnInterfaceOfTheirRatio) {
    for (const float n_glass : {1.333f, 1.5f, 2.5f}) {
        // Water everywhere; the eye looks along -z through a sheet of glass at a wall that shines.
        Scene scene = scene_from(R"({"size": [16, 16, 32], "sun": {"irradiance": [0, 0, 0]},
            "camera": {"position_vox": [8.5, 8.5, 30.5], "fov_deg": 1},
            "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
            "materials": {"lamp": {"base_color": [0, 0, 0], "emission": [1, 1, 1]}, "glass": {"absorption_per_m": [0, 0, 0]},
                          "water": {"absorption_per_m": [0, 0, 0], "ior": 1.333}, "wall": {"base_color": [0, 0, 0]}},
            "build": [{"box": {"min": [0, 0, 0], "max": [16, 16, 32], "material": "wall"}},
                      {"box": {"min": [1, 1, 1], "max": [15, 15, 31], "material": "water"}},
                      {"box": {"min": [1, 1, 12], "max": [15, 15, 15], "material": "glass"}},
                      {"box": {"min": [0, 0, 0], "max": [16, 16, 1], "material": "lamp"}}]})");
        scene.materials[MATERIAL_GLASS].ior = n_glass;
        const Picture picture = picture_of(scene, 64, {64, 64});
        const double f = std::pow((n_glass - 1.333) / (n_glass + 1.333), 2);
        const double expected = (1 - f) / (1 + f);
        if (n_glass == 1.333f)
            EXPECT_LT(picture.worst(1), 1e-6) << "no interface between equal media";
        else
            EXPECT_NEAR(picture.mean().x, expected, 4 * std::sqrt((1 - expected) / (64 * 64 * 64)))
                << n_glass;
    }
}

}  // namespace
}  // namespace tarn
