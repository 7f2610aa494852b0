// Damaged scene files: whatever the bytes, parsing gives a scene or one Error of one line, and never both a
// crash and a guess. Seeds are fixed, so a failure repeats.
#include <gtest/gtest.h>

#include "core/error.h"
#include "shared/hash.h"
#include "world/scene.h"

namespace tarn {
namespace {

// Every kind of key, in a world too small to cost time. Damage must not make it large: no digit is inserted.
constexpr auto scene_of_all_keys =
    R"({"description": "all keys", "size": [9, 8, 7], "metres_per_voxel": 0.5, "seed": 3,
 "camera": {"position_vox": [1, 2, 3], "yaw_deg": 4, "pitch_deg": 5, "fov_deg": 60},
 "sun": {"azimuth_deg": 1, "elevation_deg": 2, "irradiance": [1, 1, 1], "angular_radius_deg": 0.3},
 "sky": {"zenith": [0, 0, 1], "horizon": [1, 1, 1]},
 "materials": {"water": {"absorption_per_m": [1, 0, 0]}, "metal": {"roughness": 0.2, "metallic": 1, "ior": 2}},
 "build": [{"terrain": {"base_height_vox": 3, "octaves": 2, "shapes": [{"center": [1, 2], "radius": [3, 4],
 "height_vox": 2}], "beach": {"height_vox": 3}, "patches": {"cover": 0.5}}},
 {"box": {"min": [0, 1, 2], "max": [3, 4, 5], "material": "water"}}, {"sphere": {"center": [4, 4, 4], "radius": 2,
 "material": "glass"}}, {"spring": {"min": [0, 0, 0], "max": [1, 1, 1], "material": "sand", "per_tick": 3}},
 {"drain": {"min": [0, 0, 0], "max": [2, 2, 2]}}]})";

// Returns whether it parsed; a refusal must be one line that names the origin.
bool parses(const std::string& text) {
    try {
        const Scene scene = parse_scene(text, "fuzz.json", Settings{});
        EXPECT_GT(scene.cells.count(), 0u);
        return true;
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with("fuzz.json: ")) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_LT(message.size(), 600u) << message;
        return false;
    }
}

TEST(SceneFuzz, DamagedTextsAreReadOrRefusedInOneLine) {
    constexpr char replacements[] = "{}[]\",:.-+eEnull \n\t\\\0\x01\x7f\xff\xc3";
    const std::string good = scene_of_all_keys;
    ASSERT_TRUE(parses(good));
    int refused = 0;
    constexpr std::uint32_t runs = 20000;
    for (std::uint32_t run = 0; run < runs; ++run) {
        std::string text = good;
        for (std::uint32_t n = 0; n <= hash2(run, 0) % 3 && !text.empty(); ++n) {
            const std::size_t at = hash3(run, n, 1) % text.size();
            const char c = replacements[hash3(run, n, 2) % (sizeof(replacements) - 1)];
            switch (hash3(run, n, 3) % 4) {
                case 0:
                    text[at] = c;
                    break;
                case 1:
                    text.erase(at, 1 + hash3(run, n, 4) % 30);
                    break;
                case 2:
                    text.insert(at, 1, c);
                    break;
                default:
                    text.resize(at + 1);
            }
        }
        refused += parses(text) ? 0 : 1;
    }
    EXPECT_GT(refused, static_cast<int>(runs) / 2);
    EXPECT_LT(refused, static_cast<int>(runs)) << "some damage is to blanks and numbers, and is harmless";
}

}  // namespace
}  // namespace tarn
