// Emissive voxels across the surface of water and mirrored in it, against integrals in double precision over
// the directions at one point of a square room half full of water.
#include <numbers>

#include "microfacet_energy.h"
#include "picture.h"

namespace tarn {
namespace {

class EmittersWaterTest : public GlTest {};

constexpr double index_of_water = 1.333;
constexpr double albedo = 0.5;
constexpr double half_width_vox = 23;  // from the room's axis to its walls
constexpr double depth_vox = 4;        // of the water
constexpr double height_vox = 18;      // of the air above

// Floor at y = 1, surface at 5, ceiling at 23. One material for each part; the receiver's is `wall`, what
// shines is `lamp`, black is `stone`.
Scene room(const char* bed, const char* lower_walls, const char* upper_walls, const char* ceiling) {
    Scene scene = scene_from(R"({"size": [48, 24, 48], "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"wall": {"base_color": [0.5, 0.5, 0.5]}, "stone": {"base_color": [0, 0, 0]},
                      "lamp": {"base_color": [0, 0, 0], "emission": [1, 1, 1]},
                      "water": {"absorption_per_m": [0, 0, 0], "ior": 1.333}}})");
    for (int z = 0; z < 48; ++z)
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 48; ++x) {
                const bool side = std::min(x, z) == 0 || std::max(x, z) == 47;
                const char* part = y == 0 ? bed : y == 23 ? ceiling : y < 5 ? lower_walls : upper_walls;
                scene.cells.at({x, y, z}) = y == 0 || y == 23 || side ? *material_id(part)
                                            : y < 5                   ? MATERIAL_WATER_FULL
                                                                      : MATERIAL_AIR;
            }
    return scene;
}

// Mean over the directions of a receiver's hemisphere, weighted by their cosine, of light(theta, distance to
// the wall).
template <typename Light>
double mean_light(const Light& light) {
    constexpr int rows = 4000;
    constexpr int columns = 400;
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        const double theta = std::asin(std::sqrt((i + 0.5) / rows));
        for (int j = 0; j < columns; ++j) {
            const double phi = std::numbers::pi / 4 * (j + 0.5) / columns;  // of eight alike
            sum += light(theta, half_width_vox / std::cos(phi));
        }
    }
    return sum / (1.0 * rows * columns);
}

// Light found by chance and by sampling, shaded as steps and as smooth water, is `expected` times the albedo.
void expect_light(Scene scene, glm::vec3 eye, float pitch_deg, double expected) {
    scene.settings.camera_position_vox = eye;
    scene.settings.camera_pitch_deg = pitch_deg;
    scene.settings.camera_fov_deg = 1;
    for (const LightSampling sampling : {LightSampling::None, LightSampling::Lights})
        for (const bool smooth_water : {false, true}) {
            const Picture picture = picture_of(scene, 96, {64, 64}, [&](Settings& s) {
                s.light_sampling = sampling;
                s.smooth_water = smooth_water;
                s.max_bounces = 2;
                s.max_diffuse_bounces = 1;
                s.roulette_after = 1024;
            });
            const double error = picture.standard_error();
            EXPECT_NEAR(picture.mean().x, albedo * expected, 3 * error)
                << static_cast<int>(sampling) << " " << smooth_water;
            // Chance finds small lamps too rarely.
            EXPECT_LT(3 * error, (sampling == LightSampling::None ? 0.02 : 0.005) * albedo * expected);
            EXPECT_EQ(picture.rejected, 0u);
        }
}

TEST_F(EmittersWaterTest, ABedIsLitThroughTheSurface) {
    // All above the water shines: the walls stand beyond the critical angle.
    const double expected = mean_light([](double theta, double wall_vox) {
        if (depth_vox * std::tan(theta) > wall_vox) return 0.0;
        return (1 - exact_fresnel(std::cos(theta), 1 / index_of_water)) * index_of_water * index_of_water;
    });
    expect_light(room("wall", "stone", "lamp", "lamp"), {24, 3, 24}, -90, expected);
}

TEST_F(EmittersWaterTest, ABedIsLitByWallsAndTheirMirrorImages) {
    const double expected = mean_light([](double theta, double wall_vox) {
        const double met_vox = wall_vox / std::tan(theta);
        if (met_vox < depth_vox) return 1.0;
        return met_vox < 2 * depth_vox ? exact_fresnel(std::cos(theta), 1 / index_of_water) : 0.0;
    });
    expect_light(room("wall", "lamp", "stone", "stone"), {24, 3, 24}, -90, expected);
}

TEST_F(EmittersWaterTest, ACeilingIsLitFromUnderWater) {
    // All below the surface shines.
    const double expected = mean_light([](double theta, double wall_vox) {
        if (height_vox * std::tan(theta) > wall_vox) return 0.0;
        return (1 - exact_fresnel(std::cos(theta), index_of_water)) / (index_of_water * index_of_water);
    });
    expect_light(room("lamp", "lamp", "stone", "wall"), {24, 20, 24}, 90, expected);
}

}  // namespace
}  // namespace tarn
