// What the head of confined water does in the `pressure` tier, on the serial reference.
#include "reference/pressure_field.h"

#include <gtest/gtest.h>

#include <random>

#include "unit/water_worlds.h"

namespace tarn {
namespace {

constexpr WaterTier pressure = WaterTier::Pressure;

// Two arms 5 wide, 20 high, joined by a tunnel two high along the floor; the left holds water up to
// `height`.
Cells u_tube(int height, bool joined) {
    return make_cells({20, 24, 5}, [&](glm::ivec3 c) -> std::uint32_t {
        const bool left = c.x < 5;
        const bool right = c.x >= 15;
        if (!left && !right && !(joined && c.y < 2)) return MATERIAL_STONE;
        return left && c.y < height ? std::uint32_t{full_water} : MATERIAL_AIR;
    });
}

// Mean height of water, in voxels, over columns [from, to) of x.
double mean_height(const Cells& cells, int from, int to) {
    double quanta = 0;
    for_cells(cells, [&](glm::ivec3 c) {
        if (c.x >= from && c.x < to) quanta += quanta_of(cells.at(c));
    });
    return quanta / 16 / ((to - from) * cells.size_vox().z);
}

TEST(PressureField, water_rises_in_the_other_arm_of_a_u) {
    Cells level = u_tube(20, true);
    Cells pressed = level;
    run(level, WaterTier::Level, 800);
    run(pressed, pressure, 800);
    EXPECT_GT(mean_height(level, 0, 5) - mean_height(level, 15, 20), 4) << "the test would show nothing";
    EXPECT_NEAR(mean_height(pressed, 0, 5), mean_height(pressed, 15, 20), 1);
    // A further while keeps it so.
    run(pressed, pressure, 300, 2);
    EXPECT_NEAR(mean_height(pressed, 0, 5), mean_height(pressed, 15, 20), 1);
    EXPECT_EQ(take_census(pressed).water_quanta, 5u * 5 * 20 * 16);
}

TEST(PressureField, pools_that_are_not_joined_stay_apart) {
    Cells cells = u_tube(20, false);
    for (int z = 0; z < 5; ++z)
        for (int x = 15; x < 20; ++x)
            for (int y = 0; y < 4; ++y) cells.at({x, y, z}) = full_water;
    const Cells start = cells;
    run(cells, pressure, 300);
    EXPECT_EQ(cells, start);
}

TEST(PressureField, water_above_a_lid_does_not_press_what_is_below) {
    // A chamber, sealed and full, in a lake; another one with air in it.
    for (const int filled : {6, 3}) {
        Cells cells = make_cells({20, 20, 16}, [&](glm::ivec3 c) -> std::uint32_t {
            const bool shell = c.x >= 6 && c.x < 14 && c.z >= 4 && c.z < 12 && c.y < 8;
            const bool inside = c.x >= 7 && c.x < 13 && c.z >= 5 && c.z < 11 && c.y >= 1 && c.y < 7;
            if (inside) return c.y < 1 + filled ? std::uint32_t{full_water} : MATERIAL_AIR;
            if (shell) return MATERIAL_GLASS;
            return c.y < 15 ? std::uint32_t{full_water} : MATERIAL_AIR;
        });
        const Cells start = cells;
        run(cells, pressure, 300);
        EXPECT_EQ(cells, start) << filled;
    }
}

// Nothing but ground, open water and air over it, and perhaps a voxel of sand in so many.
Cells open_world(glm::ivec3 size_vox, std::uint32_t seed, bool to_the_top, std::uint32_t sand_in) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    std::vector<std::uint32_t> ground(std::size_t{1} * size_vox.x * size_vox.z);
    for (std::uint32_t& height : ground) height = below(size_vox.y / 2);
    return make_cells(size_vox, [&](glm::ivec3 c) -> std::uint32_t {
        if (static_cast<std::uint32_t>(c.y) < ground[c.x + size_vox.x * c.z]) return MATERIAL_STONE;
        if (sand_in > 0 && below(sand_in) == 0) return MATERIAL_SAND;
        const bool wet = to_the_top && c.x < size_vox.x / 2;
        return wet ? std::uint32_t{full_water} : water_cell(below(17));
    });
}

TEST(PressureField, open_water_behaves_as_in_level) {
    for (const glm::ivec3 size : {glm::ivec3(30, 14, 25), glm::ivec3(7, 40, 9), glm::ivec3(1, 30, 1)})
        for (const bool to_the_top : {false, true})
            for (const std::uint32_t sand_in : {0u, 3u, 30u}) {
                const std::uint32_t seed = sand_in + 1;
                Cells level = open_world(size, seed, to_the_top, sand_in);
                Cells pressed = level;
                run(level, WaterTier::Level, 120, seed);
                run(pressed, pressure, 120, seed);
                EXPECT_EQ(pressed == level, true)
                    << size.x << ", to the top: " << to_the_top << ", sand in " << sand_in;
            }
}

TEST(PressureField, head_falls_along_its_way_and_knows_a_ceiling) {
    const Cells cells = make_cells({12, 10, 1}, [](glm::ivec3 c) -> std::uint32_t {
        if (c.x < 3) return c.y < 8 ? std::uint32_t{full_water} : MATERIAL_AIR;
        return c.y == 0 ? std::uint32_t{full_water} : MATERIAL_STONE;
    });
    reference::Activity activity(cells.size_vox());
    reference::PressureField field(cells.size_vox());
    for (int tick = 0; tick < 60; ++tick) {
        activity.begin_tick();
        field.sweep(cells, activity, film);
    }
    for (int x = 0; x < 12; ++x) {
        const std::uint32_t head = field.acting({x, 0, 0});
        EXPECT_EQ(reference::height_of(head), 32) << x;
        EXPECT_EQ(reference::is_confined(head), x >= 3) << x;
        EXPECT_EQ(reference::is_pressed(head, 0), x >= 3) << x;
        EXPECT_TRUE(x <= 3 || head < field.acting({x - 1, 0, 0})) << x;
    }
    EXPECT_EQ(field.acting({0, 8, 0}), 0u);
    EXPECT_EQ(field.acting({5, 1, 0}), 0u);
}

}  // namespace
}  // namespace tarn
