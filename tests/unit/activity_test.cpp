// What is awake, and for how long.
#include "reference/activity.h"

#include <gtest/gtest.h>

#include "shared/bindings.h"
#include "shared/water.h"
#include "unit/water_worlds.h"

namespace tarn {
namespace {

using reference::Activity;

const glm::ivec3 world_size_vox(5 * BRICK_SIDE + 3, 5 * BRICK_SIDE, 6 * BRICK_SIDE + 1);

Activity asleep() {
    Activity activity(world_size_vox);
    for (int i = 0; i <= SLEEP_TICKS; ++i) activity.begin_tick();
    return activity;
}

bool brick_is_awake(const Activity& activity, glm::ivec3 brick) {
    return activity.runs(brick * BRICK_SIDE, glm::ivec3(BRICK_SIDE));
}

TEST(Activity, everything_is_awake_first_and_sleeps_after_the_same_time) {
    Activity activity(world_size_vox);
    for (int tick = 0; tick < SLEEP_TICKS; ++tick) {
        activity.begin_tick();
        EXPECT_EQ(activity.active_bricks(), 6u * 5 * 7) << tick;
        EXPECT_TRUE(activity.any_awake());
    }
    activity.begin_tick();
    EXPECT_EQ(activity.active_bricks(), 0u);
    EXPECT_FALSE(activity.any_awake());
    EXPECT_FALSE(activity.runs({0, 0, 0}, world_size_vox));
}

TEST(Activity, a_change_wakes_its_brick_and_all_neighbours_for_so_many_ticks) {
    for (const glm::ivec3 at : {glm::ivec3(2, 1, 3), glm::ivec3(0, 0, 0), glm::ivec3(5, 4, 6)}) {
        Activity activity = asleep();
        activity.changed(glm::min(at * BRICK_SIDE + BRICK_SIDE - 1, world_size_vox - 1));
        for (int tick = 0; tick < SLEEP_TICKS; ++tick) {
            activity.begin_tick();
            EXPECT_EQ(activity.active_bricks(), 1u);
            for (int z = 0; z < 7; ++z)
                for (int y = 0; y < 5; ++y)
                    for (int x = 0; x < 6; ++x) {
                        const glm::ivec3 away = glm::abs(glm::ivec3(x, y, z) - at);
                        EXPECT_EQ(brick_is_awake(activity, {x, y, z}),
                                  std::max({away.x, away.y, away.z}) <= 1);
                    }
        }
        activity.begin_tick();
        EXPECT_EQ(activity.active_bricks(), 0u);
        EXPECT_FALSE(brick_is_awake(activity, at));
    }
}

TEST(Activity, every_change_starts_the_time_anew) {
    Activity activity = asleep();
    activity.changed({0, 0, 0});
    for (int tick = 0; tick < 5 * SLEEP_TICKS; ++tick) {
        activity.begin_tick();
        ASSERT_EQ(activity.active_bricks(), 1u) << tick;
        if (tick % SLEEP_TICKS == SLEEP_TICKS - 1) activity.changed({BRICK_SIDE - 1, 0, 0});
    }
    for (int tick = 0; tick < SLEEP_TICKS; ++tick) activity.begin_tick();
    EXPECT_EQ(activity.active_bricks(), 1u);
    activity.begin_tick();
    EXPECT_EQ(activity.active_bricks(), 0u);
}

TEST(Activity, blocks_that_touch_a_brick_that_is_awake_run) {
    Activity activity = asleep();
    activity.changed(glm::ivec3(3, 2, 3) * BRICK_SIDE);
    activity.begin_tick();
    const glm::ivec3 low = glm::ivec3(2, 1, 2) * BRICK_SIDE;
    const glm::ivec3 high = glm::ivec3(5, 4, 5) * BRICK_SIDE;
    const glm::ivec3 block(2 * BRICK_SIDE - 1, BRICK_SIDE, 2 * BRICK_SIDE - 2);
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 unit(0);
        unit[axis] = 1;
        const glm::ivec3 middle = (low + high) / 2;
        const auto along = [&](int first) { return middle * (1 - unit) + unit * first; };
        EXPECT_TRUE(activity.runs(along(low[axis] - block[axis] + 1), block));
        EXPECT_TRUE(activity.runs(along(high[axis] - 1), block));
        EXPECT_FALSE(activity.runs(along(low[axis] - block[axis]), block));
        EXPECT_FALSE(activity.runs(along(high[axis]), block));
    }
    EXPECT_TRUE(activity.runs({-100, -100, -100}, glm::ivec3(200)));
}

TEST(Activity, always_awake_runs_all_and_lets_sleep_again) {
    Activity activity = asleep();
    activity.set_always_awake(true);
    activity.begin_tick();
    EXPECT_TRUE(activity.any_awake());
    EXPECT_TRUE(activity.runs({0, 0, 0}, {1, 1, 1}));
    activity.set_always_awake(false);
    activity.begin_tick();
    EXPECT_FALSE(activity.runs({0, 0, 0}, world_size_vox));
}

// Of a whole simulation: the change's own tick does not count, and the rule's settings wake.
TEST(Activity, a_simulation_at_rest_sleeps_and_wakes_when_its_rule_changes) {
    const Cells pool = make_cells(glm::ivec3(5, 3, 5) * BRICK_SIDE,
                                  [](glm::ivec3 c) { return c.y < 5 ? full_water : MATERIAL_AIR; });
    constexpr std::size_t all_bricks = 5 * 3 * 5;
    for (const WaterTier tier : {WaterTier::Block, WaterTier::Level, WaterTier::Pressure}) {
        reference::Simulation simulation = simulation_of(pool);
        Settings settings = settings_of(tier);
        simulation.step(SLEEP_TICKS, settings);
        EXPECT_EQ(simulation.active_bricks(), all_bricks);
        simulation.step(1, settings);
        EXPECT_EQ(simulation.active_bricks(), 0u);
        settings.film_threshold = film + 1;
        simulation.step(1, settings);
        EXPECT_EQ(simulation.active_bricks(), all_bricks);
        simulation.step(SLEEP_TICKS, settings);
        EXPECT_EQ(simulation.active_bricks(), 0u);
        settings.water_tier = tier == WaterTier::Block ? WaterTier::Level : WaterTier::Block;
        simulation.step(1, settings);
        EXPECT_EQ(simulation.active_bricks(), all_bricks);
        simulation.step(SLEEP_TICKS, settings);
        EXPECT_EQ(simulation.active_bricks(), 0u);
        simulation.write({3, 3, 3}, full_water);
        simulation.step(1, settings);
        EXPECT_EQ(simulation.active_bricks(), 0u) << "nothing changed";
        simulation.write({3, 11, 3}, MATERIAL_STONE);
        simulation.step(SLEEP_TICKS, settings);
        EXPECT_EQ(simulation.active_bricks(), 1u);
        simulation.step(1, settings);
        EXPECT_EQ(simulation.active_bricks(), 0u);
    }
}

}  // namespace
}  // namespace tarn
