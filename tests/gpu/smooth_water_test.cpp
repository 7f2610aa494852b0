// Energy where water of different amounts is shaded as one smooth surface.
#include <algorithm>

#include "picture.h"
#include "traversal_cases.h"

namespace tarn {
namespace {

class SmoothWaterTest : public GlTest {};

// Loose water of random amounts over a pool of random levels, under a white sky.
Scene white_soup(bool floating) {
    Scene scene = scene_from(R"({"size": [24, 12, 24],
        "camera": {"position_vox": [12, 14, 40], "pitch_deg": -12, "fov_deg": 40}, "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]}, "materials": {"water": {"absorption_per_m": [0, 0, 0]}}})");
    cases::Random random(5);
    for (int z = 0; z < 24; ++z) {
        for (int x = 0; x < 24; ++x) {
            const int quanta = 5 * 16 + 4 + random.below(9);
            for (int y = 2; y < 12; ++y) {
                const bool drop = floating && random.below(4) == 0;
                const int amount = drop ? random.below(17) : std::clamp(quanta - 16 * y, 0, 16);
                scene.cells.at({x, y, z}) = static_cast<std::uint8_t>(water_cell(amount));
            }
        }
    }
    return scene;
}

TEST_F(SmoothWaterTest, SmoothShadingLosesAndGainsNothing) {
    for (const bool floating : {false, true}) {
        for (const float pitch_deg : {-12.0f, 12.0f}) {
            Scene scene = white_soup(floating);
            scene.settings.camera_pitch_deg = pitch_deg;
            if (pitch_deg > 0) scene.settings.camera_position_vox.y = -4;
            const auto smooth = [](Settings& s) {
                s.smooth_water = true;
                s.roulette_after = 1024;
            };
            const Picture clear = picture_of(scene, 8, {64, 48}, smooth);
            if (!floating) {
                EXPECT_LT(clear.worst(1), 1e-4) << pitch_deg;
            }
            // Total reflection can hold a path in a block of flat faces for ever, once a tilted normal let it
            // in at an angle that those faces would not: some in 1e5 are lost in drops, none is gained.
            EXPECT_LT(*std::ranges::max_element(clear.image.pixels), 1 + 1e-4);
            EXPECT_GT(clear.mean().x, 1 - 1e-4);
            EXPECT_EQ(clear.rejected, 0u);
            // What a rough surface scatters to the wrong side of a face is lost; nothing may be gained.
            scene.materials[MATERIAL_WATER].roughness = 0.3f;
            const Picture rough = picture_of(scene, 8, {64, 48}, smooth);
            EXPECT_LT(rough.mean().x, 1 + 4 * rough.standard_error());
            EXPECT_GT(rough.mean().x, 0.8);
            EXPECT_EQ(rough.rejected, 0u);
        }
    }
}

}  // namespace
}  // namespace tarn
