// The scenes that come with the program: complete, the same every time, and at rest where they promise it.
#include <gtest/gtest.h>

#include "world/scene.h"

namespace tarn {
namespace {

TEST(BuiltinScenes, AreTheNineOfTheContractEachWithItsLine) {
    std::vector<std::string> names;
    for (const SceneSummary& scene : builtin_scenes()) {
        names.push_back(scene.name);
        EXPECT_GT(scene.description.size(), 10u) << scene.name;
        EXPECT_EQ(scene.description.find('\n'), std::string::npos);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"cave", "dam-break", "flat", "furnace", "gallery", "islands",
                                               "lake", "u-tube", "waterfall"}));
}

TEST(BuiltinScenes, LoadTheSameTwiceWithTheEyeInAir) {
    for (const SceneSummary& summary : builtin_scenes()) {
        const Scene scene = load_scene(summary.name, Settings{});
        EXPECT_EQ(scene.name, summary.name);
        EXPECT_EQ(hash_of(scene.cells), hash_of(load_scene(summary.name, Settings{}).cells)) << summary.name;
        const glm::ivec3 eye(glm::floor(scene.settings.camera_position_vox));
        EXPECT_EQ(scene.cells.get(eye, MATERIAL_AIR), MATERIAL_AIR) << summary.name;
        const Census census = take_census(scene.cells);
        EXPECT_LT(census.voxels[MATERIAL_AIR], scene.cells.count()) << summary.name;
        EXPECT_GT(census.voxels[MATERIAL_AIR], scene.cells.count() / 8) << summary.name;
        EXPECT_EQ(census.water_quanta, 16 * census.voxels[MATERIAL_WATER])
            << summary.name << ": built water is full";
    }
}

TEST(BuiltinScenes, HoldWhatTheirNamesPromise) {
    const auto census = [](const char* name) { return take_census(load_scene(name, Settings{}).cells); };
    for (const char* name : {"lake", "waterfall", "dam-break", "u-tube", "islands", "gallery", "cave"})
        EXPECT_GT(census(name).voxels[MATERIAL_WATER], 500u) << name;
    for (const char* name : {"lake", "islands"}) EXPECT_GT(census(name).voxels[MATERIAL_SAND], 5000u) << name;
    EXPECT_GT(census("gallery").voxels[MATERIAL_GLASS], 1000u);
    EXPECT_GT(census("gallery").voxels[MATERIAL_METAL], 1000u);
    const Scene waterfall = load_scene("waterfall", Settings{});
    ASSERT_EQ(waterfall.springs.size(), 1u);
    ASSERT_EQ(waterfall.drains.size(), 1u);
    EXPECT_GT(waterfall.springs[0].region.min_vox.y, waterfall.drains[0].region.max_vox.y + 20);
    for (const char* name :
         {"lake", "dam-break", "u-tube", "islands", "gallery", "cave", "furnace", "flat"}) {
        EXPECT_TRUE(load_scene(name, Settings{}).springs.empty()) << name;
        EXPECT_TRUE(load_scene(name, Settings{}).drains.empty()) << name;
    }
    const Scene cave = load_scene("cave", Settings{});
    EXPECT_EQ(cave.settings.sun_irradiance, glm::vec3(0));
    EXPECT_EQ(cave.settings.sky_zenith, glm::vec3(0));
    EXPECT_GT(take_census(cave.cells).voxels[MATERIAL_LAMP], 20u);
}

TEST(BuiltinScenes, TheFurnaceIsClosedAndHalfWhiteHalfBright) {
    const Scene scene = load_scene("furnace", Settings{});
    const glm::ivec3 size = scene.cells.size_vox();
    const Census census = take_census(scene.cells);
    EXPECT_EQ(census.voxels[MATERIAL_WALL] + census.voxels[MATERIAL_AIR], scene.cells.count());
    EXPECT_EQ(census.voxels[MATERIAL_AIR], (size.x - 2ull) * (size.y - 2ull) * (size.z - 2ull));
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 cell = size / 2;
        for (const int end : {0, size[axis] - 1}) {
            cell[axis] = end;
            EXPECT_EQ(scene.cells.at(cell), MATERIAL_WALL);
        }
    }
    const Material& wall = scene.materials[MATERIAL_WALL];
    EXPECT_EQ(wall.base_color, glm::vec3(0.5f));
    EXPECT_EQ(wall.emission, glm::vec3(0.5f));
    EXPECT_EQ(wall.ior, 1);
    EXPECT_EQ(wall.metallic, 0);
    EXPECT_EQ(scene.settings.sun_irradiance, glm::vec3(0));
}

// Still water at tick 0: no water has air below or beside it, and no sand can slide.
TEST(BuiltinScenes, StillOnesStartAtRest) {
    for (const char* name : {"lake", "islands", "cave", "gallery"}) {
        const Scene scene = load_scene(name, Settings{});
        const glm::ivec3 size = scene.cells.size_vox();
        const auto fluid = [&](glm::ivec3 cell) {
            const std::uint8_t byte = scene.cells.get(cell, MATERIAL_WALL);
            return byte == MATERIAL_AIR || is_water(byte);
        };
        std::uint64_t restless = 0;
        for (int z = 0; z < size.z; ++z) {
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const std::uint8_t byte = scene.cells.at({x, y, z});
                    if (!is_water(byte) && byte != MATERIAL_SAND) continue;
                    for (int d = 0; d < 9; ++d) {
                        const glm::ivec3 side(x + d % 3 - 1, y, z + d / 3 - 1);
                        const glm::ivec3 below(side.x, y - 1, side.z);
                        if (is_water(byte))
                            restless += scene.cells.get(d == 4 ? below : side, MATERIAL_WALL) == MATERIAL_AIR;
                        else
                            restless += fluid(below) && (d == 4 || fluid(side));
                    }
                }
            }
        }
        EXPECT_EQ(restless, 0u) << name;
    }
}

}  // namespace
}  // namespace tarn
