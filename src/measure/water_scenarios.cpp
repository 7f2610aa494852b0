#include "measure/water_scenarios.h"

#include <algorithm>
#include <cmath>

#include "measure/water_metrics.h"

namespace tarn {

namespace {

constexpr std::uint8_t full = MATERIAL_WATER_FULL;
constexpr int usual_ticks = 2500;
// A pool counts as flat while the standard deviation of its heights stays within this, in voxels.
constexpr double flat_sd_vox = 0.6;

void fill(Cells& cells, const Box& box, std::uint8_t byte) {
    for (int z = box.min_vox.z; z < box.max_vox.z; ++z)
        for (int y = box.min_vox.y; y < box.max_vox.y; ++y)
            for (int x = box.min_vox.x; x < box.max_vox.x; ++x) cells.at({x, y, z}) = byte;
}

LevelMeasure flatness(const Box& pool) {
    return {.goal = "flat_from_tick",
            .value = [pool](const Cells& cells) { return column_heights(cells, pool).sd; },
            .limit = flat_sd_vox,
            .axis = "sd of heights, voxels"};
}

LevelMeasure arms(const Box& left, const Box& right) {
    return {.goal = "within_1_vox_from_tick",
            .value =
                [left, right](const Cells& cells) {
                    return mean_depth_vox(cells, left) - mean_depth_vox(cells, right);
                },
            .limit = 1,
            .axis = "difference of arms, voxels"};
}

std::vector<Figure> heights_of(const Cells& cells, const Box& pool) {
    const Heights heights = column_heights(cells, pool);
    return {{"height_sd_vox", heights.sd},
            {"lowest_column_vox", heights.lowest},
            {"highest_column_vox", heights.highest}};
}

// Water spreads over the whole floor.
WaterScenario pool(const char* name, const char* what, glm::ivec3 size, const Box& water) {
    const Box world{{0, 0, 0}, size};
    return {.name = name,
            .what = what,
            .ticks_max = usual_ticks,
            .build =
                [size, water] {
                    Cells cells(size);
                    fill(cells, water, full);
                    return cells;
                },
            .level = flatness(world),
            .at_end = [world](const Cells& cells) { return heights_of(cells, world); }};
}

WaterScenario spill() {
    const Box above{{0, 30, 0}, {34, 48, 64}};
    return {.name = "spill",
            .what = "water above a sill runs over it into a lower basin",
            .ticks_max = usual_ticks,
            .build =
                [] {
                    Cells cells({64, 48, 64});
                    fill(cells, {{0, 0, 0}, {30, 20, 64}}, MATERIAL_STONE);
                    fill(cells, {{30, 0, 0}, {34, 30, 64}}, MATERIAL_STONE);
                    fill(cells, {{34, 0, 0}, {64, 4, 64}}, MATERIAL_STONE);
                    fill(cells, {{0, 20, 0}, {30, 40, 64}}, full);
                    return cells;
                },
            .at_end =
                [above](const Cells& cells) {
                    const Box lower{{34, 0, 0}, {64, 48, 64}};
                    return std::vector<Figure>{{"left_above_vox", mean_depth_vox(cells, above)},
                                               {"height_sd_vox", column_heights(cells, lower).sd}};
                }};
}

std::vector<Figure> arms_at_end(const Cells& cells, const Box& left, const Box& right) {
    const double l = mean_depth_vox(cells, left);
    const double r = mean_depth_vox(cells, right);
    return {{"arms_differ_vox", std::abs(l - r)}, {"left_arm_vox", l}, {"right_arm_vox", r}};
}

// Two arms of 8x8 joined by a tunnel of `height` x `width` x `length` voxels along the floor; the left one is
// filled to 32.
WaterScenario u_tube(const char* name, const char* what, int length, int height, int width, int ticks_max) {
    const glm::ivec3 size(16 + length, 48, 8);
    const Box left{{0, 0, 0}, {8, 48, 8}};
    const Box right{{8 + length, 0, 0}, {16 + length, 48, 8}};
    return {.name = name,
            .what = what,
            .ticks_max = ticks_max,
            .build =
                [size, length, height, width] {
                    Cells cells(size);
                    fill(cells, {{8, 0, 0}, {8 + length, 48, 8}}, MATERIAL_STONE);
                    fill(cells, {{8, 0, (8 - width) / 2}, {8 + length, height, (8 + width) / 2}}, full);
                    fill(cells, {{0, 0, 0}, {8, 32, 8}}, full);
                    return cells;
                },
            .level = arms(left, right),
            .at_end = [left, right](const Cells& cells) { return arms_at_end(cells, left, right); }};
}

// A basin of 24x24 and a shaft of 2x2, joined by a pipe of 2x2 along the floor, filled to so many voxels.
WaterScenario riser(const char* name, const char* what, int basin_vox, int shaft_vox) {
    const Box basin{{0, 0, 0}, {24, 40, 24}};
    const Box shaft{{34, 0, 11}, {36, 40, 13}};
    return {.name = name,
            .what = what,
            .ticks_max = usual_ticks,
            .build =
                [basin_vox, shaft_vox, shaft] {
                    Cells cells({40, 40, 24});
                    fill(cells, {{24, 0, 0}, {40, 40, 24}}, MATERIAL_STONE);
                    fill(cells, {{0, 0, 0}, {24, basin_vox, 24}}, full);
                    fill(cells, {{24, 0, 11}, {36, 2, 13}}, full);
                    fill(cells, shaft, MATERIAL_AIR);
                    fill(cells, {{34, 0, 11}, {36, shaft_vox, 13}}, full);
                    return cells;
                },
            .level = arms(basin, shaft),
            .at_end = [basin, shaft](const Cells& cells) { return arms_at_end(cells, basin, shaft); }};
}

// A stream into one arm must not lift the other above it.
WaterScenario tap() {
    const Box left{{0, 0, 0}, {8, 48, 8}};
    const Box right{{40, 0, 0}, {48, 48, 8}};
    LevelMeasure level = arms(left, right);
    level.false_head = true;
    return {.name = "tap",
            .what = "a tap pours into one arm of a U-tube",
            .ticks_max = usual_ticks,
            .build =
                [] {
                    Cells cells({48, 48, 8});
                    fill(cells, {{8, 0, 0}, {40, 48, 8}}, MATERIAL_STONE);
                    fill(cells, {{8, 0, 0}, {40, 4, 8}}, full);
                    fill(cells, {{0, 0, 0}, {8, 10, 8}}, full);
                    fill(cells, {{40, 0, 0}, {48, 10, 8}}, full);
                    return cells;
                },
            .tap = WaterTap{{{3, 46, 3}, {5, 47, 5}}, 300},
            .level = level,
            .at_end = [left, right](const Cells& cells) { return arms_at_end(cells, left, right); }};
}

WaterScenario point() {
    return {.name = "point",
            .what = "a tap above the middle of a floor: does water spread round?",
            .ticks_max = usual_ticks,
            .build =
                [] {
                    return Cells({128, 12, 128});
                },
            .tap = WaterTap{{{63, 8, 63}, {65, 9, 65}}, 400},
            .at_end =
                [](const Cells& cells) {
                    const Spread spread = spread_around(cells, 64, 64);
                    return std::vector<Figure>{{"volume_vox", spread.volume_vox},
                                               {"xx_over_zz", spread.xx_over_zz},
                                               {"axis_over_diagonal", spread.axis_over_diagonal},
                                               {"d1_over_d2", spread.d1_over_d2},
                                               {"c4", spread.c4}};
                }};
}

WaterScenario sand() {
    return {.name = "sand",
            .what = "a tall block of sand sinks into a pool and slides",
            .ticks_max = usual_ticks,
            .build =
                [] {
                    Cells cells({48, 48, 48});
                    fill(cells, {{0, 0, 0}, {48, 12, 48}}, full);
                    fill(cells, {{20, 20, 20}, {28, 44, 28}}, MATERIAL_SAND);
                    return cells;
                },
            .at_end =
                [](const Cells& cells) {
                    const SandPile pile = sand_pile(cells);
                    return std::vector<Figure>{{"sand_over_fluid", static_cast<double>(pile.over_fluid)},
                                               {"steep_sand_pairs", static_cast<double>(pile.steep_pairs)},
                                               {"sand_peak_vox", static_cast<double>(pile.peak_vox)}};
                }};
}

WaterScenario drain() {
    const Box above{{0, 20, 0}, {64, 48, 64}};
    return {
        .name = "drain",
        .what = "a pool at rest drains through a hole that opens in its floor",
        .ticks_max = usual_ticks,
        .build =
            [] {
                Cells cells({64, 48, 64});
                fill(cells, {{0, 0, 0}, {64, 20, 64}}, MATERIAL_STONE);
                fill(cells, {{4, 2, 4}, {60, 14, 60}}, MATERIAL_AIR);
                fill(cells, {{0, 20, 0}, {64, 26, 64}}, full);
                return cells;
            },
        .opening = Box{{28, 14, 28}, {36, 20, 36}},
        .level = LevelMeasure{.goal = "drained_from_tick",
                              .value = [above](const Cells& cells) { return mean_depth_vox(cells, above); },
                              .limit = 0.3,
                              .axis = "depth left, voxels"},
        .at_end =
            [above](const Cells& cells) {
                return std::vector<Figure>{{"left_above_vox", mean_depth_vox(cells, above)}};
            }};
}

constexpr int shaft_count = 12;
glm::ivec3 shaft_floor(int shaft) {
    return {3 + shaft * 5, 1, 5 + (shaft * 7) % 37};
}

// Sizes that no block divides, ground of waves, and shafts one voxel wide.
WaterScenario shafts() {
    return {.name = "shafts",
            .what = "shafts one voxel wide in wavy ground, under a layer of water, 61x37x45",
            .ticks_max = usual_ticks,
            .build =
                [] {
                    Cells cells({61, 37, 45});
                    for (int z = 0; z < 45; ++z)
                        for (int x = 0; x < 61; ++x) {
                            const int height =
                                12 + static_cast<int>(5 * std::sin(x * .21) + 4 * std::cos(z * .27));
                            fill(cells, {{x, 0, z}, {x + 1, height, z + 1}}, MATERIAL_STONE);
                        }
                    for (int shaft = 0; shaft < shaft_count; ++shaft) {
                        const glm::ivec3 floor = shaft_floor(shaft);
                        fill(cells, {floor, floor + glm::ivec3(1, 36, 1)}, MATERIAL_AIR);
                    }
                    fill(cells, {{0, 26, 0}, {61, 29, 45}}, full);
                    return cells;
                },
            .at_end =
                [](const Cells& cells) {
                    int dry = 0;
                    for (int shaft = 0; shaft < shaft_count; ++shaft)
                        dry += cells.at(shaft_floor(shaft)) != full;
                    return std::vector<Figure>{{"shafts_not_full", static_cast<double>(dry)}};
                }};
}

}  // namespace

std::span<const WaterScenario> water_scenarios() {
    static const std::vector<WaterScenario> scenarios = {
        pool("dam", "half a basin of 64x64, filled to 24, breaks", {64, 48, 64}, {{0, 0, 0}, {32, 24, 64}}),
        pool("blob", "a cube of water falls on the floor", {64, 48, 64}, {{24, 20, 24}, {40, 36, 40}}),
        spill(),
        u_tube("utube", "two arms joined by a tunnel 32 long, one full", 32, 4, 8, usual_ticks),
        u_tube("ulong", "the same, 160 long", 160, 4, 8, usual_ticks),
        u_tube("uthin", "the same, 160 long, 1 high and 2 wide", 160, 1, 2, 2 * usual_ticks),
        riser("riser", "a basin lifts water in a shaft of 2x2", 24, 2),
        riser("tall-arm", "a tall shaft of 2x2 empties into a basin", 12, 36),
        tap(),
        point(),
        sand(),
        drain(),
        shafts(),
        pool("bigdam", "half a basin of 160x96, filled to 16, breaks", {160, 28, 96},
             {{0, 0, 0}, {80, 16, 96}})};
    return scenarios;
}

const WaterScenario* find_water_scenario(const std::string& name) {
    const auto all = water_scenarios();
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
    return found == all.end() ? nullptr : &*found;
}

Scene scene_of(const WaterScenario& scenario, std::uint32_t seed) {
    Scene scene;
    scene.name = scenario.name;
    scene.description = scenario.what;
    scene.seed = seed;
    scene.cells = scenario.build();
    return scene;
}

}  // namespace tarn
