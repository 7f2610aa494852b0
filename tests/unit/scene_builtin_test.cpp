// The scenes that come with the program: complete, the same every time, and at rest where they promise it.
#include <gtest/gtest.h>

#include "world/scene.h"

namespace tarn {
namespace {

TEST(BuiltinScenes, AreThoseOfTheContractEachWithItsLine) {
    std::vector<std::string> names;
    for (const SceneSummary& scene : builtin_scenes()) {
        names.push_back(scene.name);
        EXPECT_GT(scene.description.size(), 10u) << scene.name;
        EXPECT_EQ(scene.description.find('\n'), std::string::npos);
    }
    EXPECT_EQ(names,
              (std::vector<std::string>{"baths", "cave", "dam-break", "flat", "fountain", "furnace",
                                        "gallery", "islands", "lake", "locks", "u-tube", "waterfall"}));
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
    for (const char* name :
         {"lake", "waterfall", "dam-break", "u-tube", "islands", "gallery", "cave", "fountain", "locks"})
        EXPECT_GT(census(name).voxels[MATERIAL_WATER], 500u) << name;
    for (const char* name : {"lake", "islands"}) EXPECT_GT(census(name).voxels[MATERIAL_SAND], 5000u) << name;
    EXPECT_GT(census("gallery").voxels[MATERIAL_GLASS], 1000u);
    EXPECT_GT(census("gallery").voxels[MATERIAL_METAL], 1000u);
    const Scene waterfall = load_scene("waterfall", Settings{});
    ASSERT_EQ(waterfall.springs.size(), 1u);
    ASSERT_EQ(waterfall.drains.size(), 1u);
    EXPECT_GT(waterfall.springs[0].region.min_vox.y, waterfall.drains[0].region.max_vox.y + 20);
    for (const char* name :
         {"lake", "dam-break", "u-tube", "islands", "gallery", "cave", "furnace", "flat", "locks"}) {
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

// The cells of water that hang together with `start` by their faces: bytes of 1 in cells' order.
std::vector<std::uint8_t> water_joined_to(const Cells& cells, glm::ivec3 start) {
    std::vector<std::uint8_t> joined(cells.count(), 0);
    std::vector<glm::ivec3> open = {start};
    while (!open.empty()) {
        const glm::ivec3 cell = open.back();
        open.pop_back();
        if (!is_water(cells.get(cell, MATERIAL_WALL)) || joined[cells.index(cell)] != 0) continue;
        joined[cells.index(cell)] = 1;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 step(0);
            step[axis] = 1;
            open.push_back(cell + step);
            open.push_back(cell - step);
        }
    }
    return joined;
}

// The air straight above the water of a column, from `cell` up.
int surface_above(const Cells& cells, glm::ivec3 cell) {
    while (is_water(cells.get(cell, MATERIAL_WALL))) ++cell.y;
    EXPECT_EQ(cells.get(cell, MATERIAL_WALL), MATERIAL_AIR);
    return cell.y;
}

// The lake's water goes through rock alone on its way to the bowl, and stands well above it; what the bowl
// spills into is apart from both.
TEST(BuiltinScenes, AClosedPipeFeedsTheFountain) {
    const Cells cells = load_scene("fountain", Settings{}).cells;
    const glm::ivec3 lake(30, 34, 20);
    const glm::ivec3 bowl(49, 20, 70);
    const std::vector<std::uint8_t> joined = water_joined_to(cells, lake);
    EXPECT_EQ(joined[cells.index(bowl)], 1);
    EXPECT_GE(surface_above(cells, lake), surface_above(cells, bowl) + 12);
    for (const glm::ivec3 apart : {glm::ivec3(41, 15, 70), {33, 11, 70}, {50, 3, 104}}) {
        EXPECT_TRUE(is_water(cells.at(apart)));
        EXPECT_EQ(joined[cells.index(apart)], 0) << apart.x;
    }
    // Under the open sky it lies in the lake and in the bowl alone.
    const auto roofed = [&](glm::ivec3 cell) {
        for (++cell.y; cell.y < cells.size_vox().y; ++cell.y)
            if (const std::uint8_t byte = cells.at(cell); byte != MATERIAL_AIR && !is_water(byte))
                return true;
        return false;
    };
    for (int z = 32; z < 64; ++z)
        for (int y = 0; y < cells.size_vox().y; ++y)
            for (int x = 0; x < cells.size_vox().x; ++x) {
                if (joined[cells.index({x, y, z})] == 0) continue;
                ASSERT_TRUE(roofed({x, y, z})) << x << " " << y << " " << z;
            }
}

// Each outer chamber and the pound it is joined to stand at different heights, and gates part all the rest.
TEST(BuiltinScenes, CulvertsJoinTwoPairsOfTheLocks) {
    const Cells cells = load_scene("locks", Settings{}).cells;
    const glm::ivec3 upper(10, 30, 42), first(50, 22, 42), middle(80, 20, 42), second(105, 15, 42),
        lower(130, 10, 42);
    const auto joined = [&](glm::ivec3 a, glm::ivec3 b) {
        EXPECT_TRUE(is_water(cells.at(a)) && is_water(cells.at(b)));
        return water_joined_to(cells, a)[cells.index(b)] == 1;
    };
    EXPECT_TRUE(joined(upper, first));
    EXPECT_TRUE(joined(second, lower));
    EXPECT_FALSE(joined(first, middle));
    EXPECT_FALSE(joined(middle, second));
    EXPECT_FALSE(joined(upper, lower));
    EXPECT_EQ(surface_above(cells, upper), 34);
    EXPECT_EQ(surface_above(cells, first), 25);
    EXPECT_EQ(surface_above(cells, middle), 25);
    EXPECT_EQ(surface_above(cells, second), 25);
    EXPECT_EQ(surface_above(cells, lower), 16);
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
