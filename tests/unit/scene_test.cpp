// Scene files: what they say is what the Scene holds; every mistake is named by place, reason and way out.
#include "world/scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/files.h"

namespace tarn {
namespace {

std::string error_of_scene(const std::string& text) {
    try {
        parse_scene(text, "bad.json", Settings{});
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

// A scene of 8^3 with `rest` after its size.
std::string scene_with(const std::string& rest) {
    return R"({"size": [8, 8, 8], )" + rest + "}";
}
std::string build_with(const std::string& item) {
    return scene_with(R"("build": [)" + item + "]");
}

struct BadScene {
    std::string text;
    std::vector<std::string> said;  // parts of the message
};

void expect_refused(const std::vector<BadScene>& bad_scenes) {
    for (const BadScene& bad : bad_scenes) {
        const std::string error = error_of_scene(bad.text);
        EXPECT_TRUE(error.starts_with("bad.json: ")) << bad.text << "\n" << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        for (const std::string& part : bad.said)
            EXPECT_NE(error.find(part), std::string::npos) << bad.text << "\n" << error << "\n" << part;
    }
}

TEST(SceneErrors, BrokenJsonIsNamedByLineAndColumn) {
    expect_refused({
        {"", {"line 1, column 1", "not JSON"}},
        {"{\"size\": [8, 8, 8]", {"line 1, column 19", "not JSON"}},
        {"{\n  \"size\": [8, 8, 8],\n  nope\n}", {"line 3, column 4", "invalid literal"}},
        {"{\"size\": [8, 8, NaN]}", {"line 1, column 17", "invalid literal"}},
        {"{\"size\": [8, 8, 8]} {}", {"line 1, column 21", "end of input"}},
        {"{\n\"metres_per_voxel\": 1e999}", {"line 2, column 25", "number overflow"}},
        {"{\"size\": \"\xff\"}", {"line 1, column 11", "UTF-8"}},
        {std::string(100000, '['), {"nested too deep"}},
        {"{\"a\n\":" + std::string(100000, 'x'), {"not JSON"}},
    });
}

TEST(SceneErrors, UnknownKeysAnywhereAreNamedWithWhatIsAllowed) {
    expect_refused({
        {scene_with(R"("colour": 1)"), {"bad.json: colour: unknown key; allowed: description, size"}},
        {scene_with(R"("camera": {"fov": 60})"), {"camera.fov: unknown key; allowed: position_vox, yaw_deg"}},
        {scene_with(R"("sun": {"colour": 60})"), {"sun.colour: unknown key", "irradiance"}},
        {scene_with(R"("sky": {"nadir": 60})"), {"sky.nadir: unknown key; allowed: zenith, horizon"}},
        {scene_with(R"("materials": {"stone": {"albedo": 1}})"),
         {"materials.stone.albedo: unknown key", "base_color"}},
        {build_with(R"({"cone": {}})"),
         {"build[0].cone: unknown key; allowed: terrain, box, sphere, spring, drain"}},
        {build_with(R"({"box": {"min": [0,0,0], "max": [1,1,1], "material": "sand"}}, {"colour": 2})"),
         {"build[1].colour: unknown key"}},
        {build_with(R"({"box": {"min": [0,0,0], "max": [1,1,1], "material": "sand", "colour": 1}})"),
         {"build[0].box.colour: unknown key; allowed: min, max, material"}},
        {build_with(R"({"terrain": {"shapes": [{"height": 3}]}})"),
         {"build[0].terrain.shapes[0].height: unknown key"}},
        {build_with(R"({"terrain": {"beach": {"x": 3}}})"), {"build[0].terrain.beach.x: unknown key"}},
        {build_with(R"({"drain": {"min": [0,0,0], "max": [1,1,1], "material": "sand"}})"),
         {"drain.material: unknown"}},
        {scene_with("\"a\\nb\\u0007\": 1"), {"a?b?: unknown key"}},
    });
}

TEST(SceneErrors, KeysGivenTwiceAreErrors) {
    expect_refused({
        {R"({"size": [8, 8, 8], "size": [9, 9, 9]})", {"size: key given twice"}},
        {scene_with(R"("sky": {"zenith": [0,0,0], "zenith": [1,1,1]})"), {"sky.zenith: key given twice"}},
        {build_with(R"({"box": {"min": [0,0,0], "max": [1,1,1], "material": "sand", "min": [0,0,0]}})"),
         {"build[0].box.min: key given twice"}},
    });
}

TEST(SceneErrors, SizesFrom1To1024) {
    const std::string range = "a whole number from 1 to 1024";
    expect_refused({
        {"{}", {"size: missing"}},
        {"[]", {"an array of 0 where an object is needed"}},
        {"3", {"3 where an object is needed"}},
        {R"({"size": [0, 8, 8]})", {"size[0]: 0 is out of range", range}},
        {R"({"size": [8, 5000, 8]})", {"size[1]: 5000 is out of range", range}},
        {R"({"size": [8, 8, -1]})", {"size[2]: -1 is out of range", range}},
        {R"({"size": [8, 8, 1025]})", {"size[2]: 1025 is out of range"}},
        {R"({"size": [8, 8, 8.5]})", {"size[2]: 8.5 is not a whole number", range}},
        {R"({"size": [8, 8, 1e30]})", {"size[2]: 1e+30 is out of range"}},
        {R"({"size": [8, 8, 18446744073709551615]})", {"size[2]: 18446744073709551615 is out of range"}},
        {R"({"size": [8, 8]})", {"size: an array of 2 where 3 numbers are needed"}},
        {R"({"size": 8})", {"size: 8 where 3 numbers are needed"}},
        {R"({"size": ["8", 8, 8]})", {"size[0]: \"8\" where a whole number is needed"}},
        {R"({"size": [null, 8, 8]})", {"size[0]: null where"}},
    });
}

TEST(SceneErrors, NumbersMustFitTheirRanges) {
    expect_refused({
        {scene_with(R"("metres_per_voxel": 0)"),
         {"metres_per_voxel: 0 is out of range; allowed: 0.0001 to 10000"}},
        {scene_with(R"("metres_per_voxel": "1")"), {"metres_per_voxel: \"1\" where a number is needed"}},
        {scene_with(R"("metres_per_voxel": true)"), {"metres_per_voxel: true where a number"}},
        {scene_with(R"("seed": -1)"),
         {"seed: -1 is out of range; allowed: a whole number from 0 to 4294967295"}},
        {scene_with(R"("seed": 4294967296)"), {"seed: 4294967296 is out of range"}},
        {scene_with(R"("seed": 1.5)"), {"seed: 1.5 is not a whole number"}},
        {scene_with(R"("description": 3)"), {"description: 3 where text is needed"}},
        {scene_with(R"("camera": {"fov_deg": 180})"),
         {"camera.fov_deg: 180 is out of range; allowed: 1 to 179"}},
        {scene_with(R"("camera": {"position_vox": [1e9, 0, 0]})"),
         {"camera.position_vox[0]", "-10000000 to 10000000"}},
        {scene_with(R"("camera": {"pitch_deg": 91})"), {"camera.pitch_deg: 91", "-90 to 90"}},
        {scene_with(R"("camera": [])"), {"camera: an array of 0 where an object is needed"}},
        {scene_with(R"("sun": {"irradiance": [-1, 0, 0]})"), {"sun.irradiance[0]: -1 is out of range"}},
        {scene_with(R"("sky": {"zenith": [0, 0]})"),
         {"sky.zenith: an array of 2 where 3 numbers are needed"}},
        {scene_with(R"("sky": {"model": "blue"})"),
         {"sky.model: no such choice", "one of gradient, preetham"}},
        {scene_with(R"("sky": {"model": 1})"), {"sky.model: 1 where text is needed"}},
        {scene_with(R"("sky": {"turbidity": 1})"), {"sky.turbidity: 1 is out of range", "2 to 10"}},
        {scene_with(R"("sun": {"time_of_day_h": 25})"), {"sun.time_of_day_h: 25", "0 to 24"}},
        {scene_with(R"("materials": {"stone": {"ior": 0.7}})"), {"materials.stone.ior: 0.7", "0.75 to 3"}},
        {scene_with(R"("materials": {"stone": {"roughness": 1.1}})"),
         {"materials.stone.roughness: 1.1", "0 to 1"}},
        {scene_with(R"("materials": {"stone": {"metallic": -0.1}})"), {"metallic: -0.1", "0 to 1"}},
        {scene_with(R"("materials": {"stone": {"base_color": [0, 2, 0]}})"), {"base_color[1]: 2", "0 to 1"}},
        {scene_with(R"("materials": {"water": {"absorption_per_m": [0, 0, 20000]}})"),
         {"per_m[2]: 20000", "0 to 10000"}},
        {scene_with(R"("materials": {"lamp": {"emission": [2e6, 0, 0]}})"), {"emission[0]", "0 to 1000000"}},
        {scene_with(R"("materials": {"lava": {}})"),
         {"materials.lava: unknown material; allowed: stone, dirt"}},
        {scene_with(R"("materials": {"air": {}})"), {"materials.air: air has no surface"}},
    });
}

TEST(SceneErrors, BuildItemsMustMakeSense) {
    expect_refused({
        {scene_with(R"("build": {})"), {"build: an object where an array is needed"}},
        {build_with("3"), {"build[0]: 3 where an object is needed"}},
        {build_with("{}"), {"build[0]: an object of 0 keys where one key is needed"}},
        {build_with(R"({"terrain": {}, "box": {}})"), {"build[0]: an object of 2 keys"}},
        {build_with(R"({"box": {"min": [0,0,0], "max": [1,1,1]}})"), {"build[0].box.material: missing"}},
        {build_with(R"({"box": {"min": [0,0,0], "max": [1,1,1], "material": "lava"}})"),
         {"build[0].box.material: unknown material \"lava\"; allowed: air, stone", "water"}},
        {build_with(R"({"box": {"min": [0,0,0], "max": [1,1,1], "material": 3}})"),
         {"material: 3 where text"}},
        {build_with(R"({"box": {"min": [0,5,0], "max": [1,5,1], "material": "sand"}})"),
         {"build[0].box.max[1]: 5 is not above min 5"}},
        {build_with(R"({"box": {"min": [2,0,0], "max": [1,5,1], "material": "sand"}})"),
         {"max[0]: 1 is not above min 2"}},
        {build_with(R"({"box": {"min": [0.5,0,0], "max": [1,5,1], "material": "sand"}})"),
         {"min[0]: 0.5 is not a whole"}},
        {build_with(R"({"sphere": {"center": [0,0,0], "radius": -1, "material": "sand"}})"),
         {"radius: -1 is out of"}},
        {build_with(R"({"spring": {"min": [0,0,0], "max": [9,1,1], "per_tick": 1}})"),
         {"build[0].spring.max[0]: 9 is outside the world; allowed: 1 to 8"}},
        {build_with(R"({"spring": {"min": [-1,0,0], "max": [1,1,1], "per_tick": 1}})"),
         {"min[0]: -1 is outside"}},
        {build_with(R"({"spring": {"min": [0,0,0], "max": [1,1,1], "material": "stone", "per_tick": 1}})"),
         {"material: a spring cannot make stone; allowed: water, sand"}},
        {build_with(R"({"spring": {"min": [0,0,0], "max": [1,1,1]}})"), {"spring.per_tick: missing"}},
        {build_with(R"({"spring": {"min": [0,0,0], "max": [1,1,1], "per_tick": 2147483649}})"),
         {"per_tick: 2147483649 is out of range; allowed: a whole number from 0 to 2147483648"}},
        {build_with(R"({"drain": {"min": [0,0,8], "max": [1,1,9]}})"),
         {"drain.max[2]: 9 is outside the world"}},
        {build_with(R"({"terrain": {"octaves": 11}})"),
         {"octaves: 11 is out of range; allowed: a whole number from 1 to 10"}},
        {build_with(R"({"terrain": {"wavelength_vox": 0}})"), {"wavelength_vox: 0 is out of range"}},
        {build_with(R"({"terrain": {"shapes": [{"center": [1], "radius": [1,1], "height_vox": 1}]}})"),
         {"shapes[0].center: an array of 1 where 2 numbers are needed"}},
    });
}

TEST(SceneErrors, AMistakeIsFoundBeforeTheLargestWorldIsBuilt) {
    const auto start = std::chrono::steady_clock::now();
    expect_refused(
        {{R"({"size": [1024, 1024, 1024], "build": [{"terrain": {}}, {"cone": {}}]})", {"build[1].cone"}}});
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100));
}

TEST(SceneErrors, UnknownScenesAndFilesAreNamed) {
    const auto message = [](const std::string& name) -> std::string {
        try {
            load_scene(name, Settings{});
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_NE(message("atlantis").find("scene atlantis: no built-in scene"), std::string::npos);
    EXPECT_NE(message("atlantis").find("lake, locks, u-tube, waterfall"), std::string::npos);
    EXPECT_NE(message("").find("no built-in scene"), std::string::npos);
    EXPECT_NE(message("no/such.json").find("no/such.json: cannot read"), std::string::npos);
    EXPECT_NE(message("nosuch.json").find("nosuch.json: cannot read"), std::string::npos);
    EXPECT_NE(message("/").find("is a directory"), std::string::npos);
}

TEST(Scene, TheHourPlacesTheSunWhereTheFileDoesNot) {
    const auto settings_of = [](const std::string& rest) {
        return parse_scene(R"({"size": [1, 1, 1], )" + rest + "}", "test", Settings{}).settings;
    };
    const Settings clear = settings_of(
        R"("sky": {"model": "preetham", "turbidity": 4, "brightness": 2}, "sun": {"time_of_day_h": 12})");
    EXPECT_EQ(clear.sky_model, SkyModel::Preetham);
    EXPECT_EQ(clear.turbidity, 4);
    EXPECT_EQ(clear.sky_brightness, 2);
    EXPECT_EQ(clear.sun_azimuth_deg, 180);
    EXPECT_NEAR(clear.sun_elevation_deg, 63.44, 1e-4);
    const Settings both = settings_of(R"("sun": {"elevation_deg": 7, "time_of_day_h": 12})");
    EXPECT_EQ(both.sky_model, SkyModel::Gradient);
    EXPECT_EQ(both.sun_elevation_deg, 7);
    EXPECT_EQ(both.sun_azimuth_deg, 180);
}

TEST(Scene, HoldsWhatTheFileSays) {
    Settings base;
    base.max_bounces = 9;
    base.sky_horizon = {4, 5, 6};
    const Scene scene = parse_scene(R"({
        "description": "a test", "size": [7, 13, 5], "metres_per_voxel": 0.5, "seed": 4294967295,
        "camera": {"position_vox": [1e6, -2, 3.5], "yaw_deg": 10, "pitch_deg": -20, "fov_deg": 30},
        "sun": {"azimuth_deg": 40, "elevation_deg": 50, "irradiance": [1, 2, 3], "angular_radius_deg": 0},
        "sky": {"zenith": [0.1, 0.2, 0.3]},
        "materials": {"water": {"absorption_per_m": [1, 0, 2], "ior": 1.5},
                      "stone": {"base_color": [0, 0.5, 1], "roughness": 0.25, "metallic": 1, "emission": [7, 8, 9]}},
        "build": [
            {"box": {"min": [-5, 0, 0], "max": [99, 2, 99], "material": "stone"}},
            {"box": {"min": [1, 1, 1], "max": [3, 3, 3], "material": "water"}},
            {"box": {"min": [50, 50, 50], "max": [51, 51, 51], "material": "metal"}},
            {"sphere": {"center": [5.5, 8.5, 2.5], "radius": 1, "material": "sand"}},
            {"spring": {"min": [0, 10, 0], "max": [2, 13, 5], "per_tick": 2147483648}},
            {"spring": {"min": [0, 10, 0], "max": [1, 11, 1], "material": "sand", "per_tick": 0}},
            {"drain": {"min": [6, 0, 4], "max": [7, 13, 5]}}
        ]})",
                                    "folder/test.json", base);
    EXPECT_EQ(scene.name, "test");
    EXPECT_EQ(scene.description, "a test");
    EXPECT_EQ(scene.seed, 4294967295u);
    EXPECT_EQ(scene.metres_per_voxel, 0.5f);
    EXPECT_EQ(scene.cells.size_vox(), glm::ivec3(7, 13, 5));
    EXPECT_EQ(scene.settings.max_bounces, 9) << "what the scene does not set comes from the base";
    EXPECT_EQ(scene.settings.sky_horizon, glm::vec3(4, 5, 6));
    EXPECT_EQ(scene.settings.sky_zenith, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(scene.settings.camera_position_vox, glm::vec3(1e6f, -2, 3.5f));
    EXPECT_EQ(scene.settings.camera_yaw_deg, 10);
    EXPECT_EQ(scene.settings.camera_pitch_deg, -20);
    EXPECT_EQ(scene.settings.camera_fov_deg, 30);
    EXPECT_EQ(scene.settings.sun_azimuth_deg, 40);
    EXPECT_EQ(scene.settings.sun_elevation_deg, 50);
    EXPECT_EQ(scene.settings.sun_irradiance, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.settings.sun_angular_radius_deg, 0);
    EXPECT_EQ(scene.settings.water_ior, 1.5f);
    EXPECT_NEAR(scene.settings.water_color.x, std::exp(-1), 1e-6);
    const Material& stone = scene.materials[MATERIAL_STONE];
    EXPECT_EQ(stone.base_color, glm::vec3(0, 0.5f, 1));
    EXPECT_EQ(stone.roughness, 0.25f);
    EXPECT_EQ(stone.metallic, 1);
    EXPECT_EQ(stone.emission, glm::vec3(7, 8, 9));
    EXPECT_EQ(stone.ior, default_materials()[MATERIAL_STONE].ior) << "not given, so the default";
    EXPECT_EQ(scene.materials[MATERIAL_DIRT], default_materials()[MATERIAL_DIRT]);
    const Census census = take_census(scene.cells);
    EXPECT_EQ(census.voxels[MATERIAL_STONE], 7u * 2 * 5 - 4) << "boxes are clipped; water replaced four";
    EXPECT_EQ(census.voxels[MATERIAL_WATER], 8u);
    EXPECT_EQ(census.water_quanta, 128u) << "built water is full";
    EXPECT_EQ(census.voxels[MATERIAL_METAL], 0u);
    EXPECT_EQ(census.voxels[MATERIAL_SAND], 7u) << "the centre's cell and its six neighbours";
    EXPECT_EQ(scene.cells.at({5, 8, 2}), MATERIAL_SAND);
    ASSERT_EQ(scene.springs.size(), 2u);
    EXPECT_EQ(scene.springs[0], (Spring{{{0, 10, 0}, {2, 13, 5}}, MATERIAL_WATER, 2147483648u}));
    EXPECT_EQ(scene.springs[1], (Spring{{{0, 10, 0}, {1, 11, 1}}, MATERIAL_SAND, 0}));
    ASSERT_EQ(scene.drains.size(), 1u);
    EXPECT_EQ(scene.drains[0], (Drain{{{6, 0, 4}, {7, 13, 5}}}));
}

TEST(Scene, ASizeAloneIsAnEmptyWorld) {
    const Scene scene = parse_scene(R"({"size": [1, 1, 1]})", "one.json", Settings{});
    EXPECT_EQ(scene.cells, Cells({1, 1, 1}));
    Settings expected;
    water_settings_from(scene.materials, expected);
    EXPECT_EQ(scene.settings, expected);
}

TEST(Scene, ASeedFromOutsideOverridesTheFile) {
    const std::string text = R"({"size": [32, 32, 32], "seed": 3, "build": [{"terrain": {}}]})";
    const Scene three = parse_scene(text, "a.json", Settings{});
    EXPECT_EQ(three.seed, 3u);
    EXPECT_EQ(parse_scene(text, "a.json", Settings{}, 3).cells, three.cells);
    const Scene four = parse_scene(text, "a.json", Settings{}, 4);
    EXPECT_EQ(four.seed, 4u);
    EXPECT_NE(four.cells, three.cells);
}

TEST(Scene, AFileLoadsLikeItsText) {
    const auto path = std::filesystem::path(testing::TempDir()) / fmt::format("tarn_scene_{}.json", getpid());
    write_file(
        path,
        R"({"size": [4, 4, 4], "build": [{"box": {"min": [0,0,0], "max": [4,1,4], "material": "glass"}}]})");
    const Scene scene = load_scene(path.string(), Settings{});
    std::filesystem::remove(path);
    EXPECT_EQ(scene.name, path.stem().string());
    EXPECT_EQ(take_census(scene.cells).voxels[MATERIAL_GLASS], 16u);
}

}  // namespace
}  // namespace tarn
