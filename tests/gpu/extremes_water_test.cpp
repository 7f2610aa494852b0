// Extremes where most of the tracer's code runs at once: lamps in and over rippled water, rough glass, metals
// and sand, under a sun and a clear sky, in every quality. No closed form: finite, nothing rejected, nothing
// beyond what shines.
#include "studio.h"

namespace tarn {
namespace {

class ExtremesWaterTest : public GlTest {};

Scene everything() {
    Scene scene = scene_from(R"({"size": [24, 16, 24], "metres_per_voxel": 0.25,
        "camera": {"position_vox": [12, 13, 23], "pitch_deg": -35, "fov_deg": 70},
        "sun": {"azimuth_deg": 60, "elevation_deg": 40}, "sky": {"model": "preetham"},
        "materials": {"glass": {"roughness": 0.4}, "metal": {"roughness": 0.3},
                      "stone": {"ior": 1.5, "roughness": 0.2}},
        "build": [{"box": {"min": [0, 0, 0], "max": [24, 2, 24], "material": "sand"}},
                  {"box": {"min": [2, 2, 2], "max": [22, 5, 18], "material": "water"}},
                  {"box": {"min": [5, 2, 6], "max": [7, 3, 8], "material": "lamp"}},
                  {"box": {"min": [16, 9, 4], "max": [18, 10, 6], "material": "lamp"}},
                  {"box": {"min": [10, 2, 8], "max": [14, 8, 12], "material": "glass"}},
                  {"box": {"min": [17, 2, 10], "max": [20, 7, 13], "material": "metal"}},
                  {"box": {"min": [3, 2, 12], "max": [6, 6, 15], "material": "stone"}}]})");
    for (int z = 2; z < 18; ++z)
        for (int x = 2; x < 22; ++x)
            if (scene.cells.at({x, 4, z}) == MATERIAL_WATER_FULL)
                scene.cells.at({x, 4, z}) = static_cast<std::uint8_t>(water_cell(7 + (x * 5 + z * 3) % 7));
    return scene;
}

// In each quality, from above and from under water.
void expect_sound(const Scene& scene, const std::string& what) {
    for (const Quality quality :
         {Quality::Baseline, Quality::Fast, Quality::Balanced, Quality::Quality, Quality::Exact}) {
        Studio studio(scene);
        apply_quality(studio.settings(), quality);
        for (const glm::vec3 eye : {glm::vec3(12, 13, 23), glm::vec3(8.5f, 3.3f, 10.5f)}) {
            studio.settings().camera_position_vox = eye;
            for (int frame = 0; frame < 3; ++frame) {
                const Picture picture = studio.shoot({24, 16});
                EXPECT_TRUE(all_finite(picture)) << what << " quality " << static_cast<int>(quality);
                EXPECT_EQ(picture.rejected, 0u) << what << " quality " << static_cast<int>(quality);
                EXPECT_TRUE(std::ranges::all_of(picture.image.pixels, [](float p) { return p >= 0; }))
                    << what;
            }
        }
    }
}

TEST_F(ExtremesWaterTest, IndicesAndRoughnesses) {
    for (const auto& [index, roughness] :
         {std::pair(0.75f, 0.f), {0.75f, 1.f}, {1.f, 1e-3f}, {1.0001f, 0.04f}, {3.f, 0.f}, {3.f, 1.f}}) {
        Scene scene = everything();
        scene.settings.water_ior = index;
        for (const auto id : {MATERIAL_WATER, MATERIAL_GLASS, MATERIAL_METAL, MATERIAL_STONE})
            scene.materials[id].roughness = roughness;
        scene.materials[MATERIAL_GLASS].ior = index;
        expect_sound(scene, fmt::format("index {} roughness {}", index, roughness));
    }
}

TEST_F(ExtremesWaterTest, RadianceAbsorptionAndTheSunsHeight) {
    for (const float radiance : {1e-6f, 1e6f}) {
        Scene scene = everything();
        scene.materials[MATERIAL_LAMP].emission = glm::vec3(radiance);
        expect_sound(scene, fmt::format("radiance {}", radiance));
    }
    for (const float absorption : {0.f, 1e4f}) {
        Scene scene = everything();
        for (const auto id : {MATERIAL_WATER, MATERIAL_GLASS})
            scene.materials[id].absorption_per_m = glm::vec3(absorption);
        scene.settings.water_color = glm::vec3(absorption > 0 ? 1e-4f : 1);
        expect_sound(scene, fmt::format("absorption {}", absorption));
    }
    for (const float elevation_deg : {-90.f, -1e-3f, 0.f, 1e-3f, 90.f}) {
        Scene scene = everything();
        scene.settings.sun_elevation_deg = elevation_deg;
        scene.settings.sun_angular_radius_deg = elevation_deg == 0 ? 90 : elevation_deg > 0 ? 0 : 0.27f;
        expect_sound(scene, fmt::format("elevation {}", elevation_deg));
    }
}

}  // namespace
}  // namespace tarn
