// What is at rest sleeps, what changes wakes, and nobody can tell from the water that it slept.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "app/simulation.h"
#include "gpu/conservation.h"
#include "gpu/gl_test.h"
#include "gpu/worlds.h"
#include "reference/simulation.h"
#include "shared/bindings.h"
#include "shared/water.h"

namespace tarn {
namespace {

using SleepTest = GlTest;

constexpr std::array tiers{WaterTier::Block, WaterTier::Level, WaterTier::Pressure};

Settings settings_of(WaterTier tier) {
    Settings settings;
    settings.water_tier = tier;
    return settings;
}

// The GPU's world and the reference's, stepped and edited alike.
class Pair {
  public:
    explicit Pair(const Scene& scene, std::uint64_t tick = 0)
        : simulation_(scene, timers_), reference_(scene, tick) {
        simulation_.set_tick(tick);
    }

    void step(int n, const Settings& settings) {
        simulation_.step(n, settings);
        reference_.step(n, settings);
    }
    void write(glm::ivec3 cell, std::uint8_t byte) {
        simulation_.write({{cell, reference_.cells().at(cell), byte}});
        reference_.write(cell, byte);
    }
    // Ticks until nothing is active, at most `limit`. The GPU counts bricks from the tick they wake in, the
    // reference from the next on.
    int ticks_to_sleep(int limit, const Settings& settings) {
        std::size_t before = simulation_.active_bricks();
        for (int ticks = 1; ticks <= limit; ++ticks) {
            step(1, settings);
            const std::size_t active = simulation_.active_bricks();
            const std::size_t expected = reference_.active_bricks();
            if (active < expected || expected > before) {
                ADD_FAILURE() << "tick " << reference_.tick() - 1 << ": active bricks " << active
                              << ", before " << before << ", reference " << expected;
                return -1;
            }
            if (active == 0) return ticks;
            before = active;
        }
        return limit + 1;
    }
    testing::AssertionResult agree() const {
        return same_cells(simulation_.read_cells(), reference_.cells());
    }

    Simulation& simulation() { return simulation_; }
    const reference::Simulation& reference() const { return reference_; }

  private:
    gl::Timers timers_;
    Simulation simulation_;
    reference::Simulation reference_;
};

template <typename Fill>
Scene make_scene(glm::ivec3 size_vox, const Fill& fill, std::uint32_t seed = 1) {
    Scene scene;
    scene.seed = seed;
    scene.cells = Cells(size_vox);
    for (int z = 0; z < size_vox.z; ++z)
        for (int y = 0; y < size_vox.y; ++y)
            for (int x = 0; x < size_vox.x; ++x)
                scene.cells.at({x, y, z}) = static_cast<std::uint8_t>(fill(glm::ivec3(x, y, z)));
    return scene;
}

// A step of water, and a pocket that only a head fills.
Scene small_dam() {
    return make_scene({28, 14, 12}, [](glm::ivec3 c) -> std::uint32_t {
        if (c.x == 20) return c.y < 1 ? MATERIAL_AIR : MATERIAL_STONE;
        return c.x < 8 && c.y < 10 ? MATERIAL_WATER_FULL : MATERIAL_AIR;
    });
}

TEST_F(SleepTest, what_is_active_follows_the_reference_at_every_tick) {
    for (const WaterTier tier : tiers) {
        SCOPED_TRACE(name_of(tier));
        Pair pair(small_dam());
        EXPECT_EQ(pair.simulation().active_bricks(), 7u * 4 * 3);
        const int ticks = pair.ticks_to_sleep(600, settings_of(tier));
        EXPECT_EQ(pair.reference().active_bricks() == 0, ticks <= 600);
        EXPECT_TRUE(tier == WaterTier::Block || (ticks > SLEEP_TICKS && ticks <= 600)) << ticks;
        EXPECT_TRUE(pair.agree());
    }
}

TEST_F(SleepTest, edits_undo_and_another_rule_wake) {
    for (const WaterTier tier : {WaterTier::Level, WaterTier::Pressure}) {
        SCOPED_TRACE(name_of(tier));
        Pair pair(small_dam());
        Settings settings = settings_of(tier);
        ASSERT_LE(pair.ticks_to_sleep(600, settings), 600);

        // Written: two cells at the world's ends, and between them what stays as it is.
        pair.write({0, 13, 0}, MATERIAL_SAND);
        pair.write({27, 13, 11}, MATERIAL_WATER_FULL);
        pair.write({10, 0, 5}, pair.reference().cells().at({10, 0, 5}));
        EXPECT_EQ(pair.simulation().active_bricks(), 2u);
        EXPECT_GT(pair.ticks_to_sleep(600, settings), SLEEP_TICKS);
        EXPECT_TRUE(pair.agree());

        // The brush, and its undo: the dam's wall opens, and closes in the water.
        Simulation& simulation = pair.simulation();
        const Cells before = simulation.read_cells();
        EditHistory history;
        history.begin_stroke();
        simulation.apply({.tick = simulation.tick(),
                          .center_vox = {20, 2, 6},
                          .radius_vox = 2,
                          .material = MATERIAL_AIR,
                          .overwrite = true},
                         history);
        EXPECT_GT(simulation.active_bricks(), 0u);
        const auto undone = history.undo();
        ASSERT_TRUE(undone.has_value());
        simulation.write(*undone);
        EXPECT_TRUE(same_cells(simulation.read_cells(), before));
        simulation.step(SLEEP_TICKS, settings);
        EXPECT_GT(simulation.active_bricks(), 0u);
        simulation.step(600, settings);
        EXPECT_EQ(simulation.active_bricks(), 0u);

        // An edit that changes nothing wakes nothing; another rule wakes everything.
        history.begin_stroke();
        simulation.apply({.tick = simulation.tick(), .center_vox = {20, 12, 6}, .material = MATERIAL_STONE},
                         history);
        EXPECT_EQ(simulation.active_bricks(), 0u);
        settings.film_threshold += 1;
        simulation.step(1, settings);
        EXPECT_EQ(simulation.active_bricks(), 7u * 4 * 3);
        simulation.step(900, settings);
        EXPECT_EQ(simulation.active_bricks(), 0u);
        settings.water_tier = tier == WaterTier::Level ? WaterTier::Pressure : WaterTier::Level;
        simulation.step(1, settings);
        EXPECT_EQ(simulation.active_bricks(), 7u * 4 * 3);
    }
}

TEST_F(SleepTest, edits_far_apart_wake_only_what_is_near) {
    const auto lake = [](glm::ivec3 c) -> std::uint32_t {
        return c.y < 7 ? MATERIAL_WATER_FULL : MATERIAL_AIR;
    };
    for (const WaterTier tier : tiers) {
        SCOPED_TRACE(name_of(tier));
        Pair pair(make_scene({150, 20, 90}, lake));
        const Settings settings = settings_of(tier);
        pair.step(SLEEP_TICKS + 1, settings);
        ASSERT_EQ(pair.simulation().active_bricks(), 0u);
        for (const glm::ivec3 cell : {glm::ivec3(0, 19, 0), glm::ivec3(149, 12, 89), glm::ivec3(75, 3, 40)})
            pair.write(cell, MATERIAL_SAND);
        EXPECT_EQ(pair.simulation().active_bricks(), 3u);
        pair.step(20, settings);
        EXPECT_LT(pair.simulation().active_bricks(), 1000u);
        pair.step(40, settings);
        EXPECT_TRUE(pair.agree());
    }
}

// A spring fills a basin to its mouth, all falls asleep, and the basin is emptied again.
TEST_F(SleepTest, what_is_put_to_sleep_lies_until_it_is_woken) {
    Scene scene;
    scene.cells = Cells({32, 32, 32});
    for (int y = 8; y < 24; ++y) scene.cells.at({16, y, 16}) = MATERIAL_WATER_FULL;  // hangs in the air
    for (const WaterTier tier : tiers) {
        gl::Timers timers;
        Simulation simulation(scene, timers);
        EXPECT_EQ(simulation.active_bricks(), 8u * 8 * 8) << name_of(tier);
        simulation.put_to_sleep();
        EXPECT_EQ(simulation.active_bricks(), 0u) << name_of(tier);
        simulation.step(2 * SLEEP_TICKS, settings_of(tier));
        EXPECT_EQ(simulation.read_cells(), scene.cells) << name_of(tier);
        simulation.write({{{16, 8, 16}, MATERIAL_WATER_FULL, MATERIAL_STONE}});
        simulation.step(2, settings_of(tier));
        EXPECT_NE(simulation.active_bricks(), 0u) << name_of(tier);
        EXPECT_EQ(simulation.read_cell({16, 8, 16}), MATERIAL_STONE) << name_of(tier);
        simulation.put_to_sleep();
        EXPECT_EQ(simulation.active_bricks(), 0u) << name_of(tier);
        simulation.set_tick(simulation.tick());  // wakes all
        simulation.step(8, settings_of(tier));
        EXPECT_EQ(simulation.read_cell({16, 23, 16}), MATERIAL_AIR) << name_of(tier);  // the column fell
    }
}

TEST_F(SleepTest, a_spring_in_sleeping_water_runs_on) {
    for (const WaterTier tier : tiers) {
        SCOPED_TRACE(name_of(tier));
        Scene scene = make_scene({60, 12, 20}, [](glm::ivec3 c) -> std::uint32_t {
            return c.x >= 12 ? MATERIAL_STONE : MATERIAL_AIR;
        });
        scene.springs = {{.region = {{2, 11, 2}, {6, 12, 6}}, .material = MATERIAL_WATER, .per_tick = 400}};
        Pair pair(scene);
        const Settings settings = settings_of(tier);
        // In the tier block the water is never quite at rest, nor soon at the basin's ends.
        const bool rests = tier != WaterTier::Block;
        pair.step(400, settings);
        EXPECT_EQ(pair.simulation().active_bricks() == 0, rests);
        constexpr double full = 12 * 12 * 20 * 16;
        constexpr double uneven = full / 100;
        // Far from the spring first: its bricks sleep on while the surface falls there.
        for (int round = 0; round < 3; ++round) {
            const glm::ivec3 low = round == 0 ? glm::ivec3(8, 0, 16) : glm::ivec3(0);
            for (int z = low.z; z < 20; ++z)
                for (int y = 0; y < (round == 2 ? 12 : 4); ++y)
                    for (int x = low.x; x < 12; ++x) pair.write({x, y, z}, MATERIAL_AIR);
            const auto taken = static_cast<double>(pair.simulation().edit_totals().removed.water_quanta);
            pair.step(round == 2 ? 300 : 150, settings);
            const FlowTotals flow = pair.simulation().flow_totals();
            EXPECT_EQ(flow.sprung_water_quanta, pair.reference().flow().sprung_water_quanta);
            EXPECT_TRUE(!rests ||
                        std::abs(static_cast<double>(flow.sprung_water_quanta) - full - taken) < uneven)
                << "round " << round << ": " << flow.sprung_water_quanta;
            EXPECT_TRUE(pair.agree());
        }
    }
}

// Whether a block holds what moves is asked of 32 bricks along x at once.
TEST_F(SleepTest, lonely_water_moves_wherever_it_lies) {
    for (const int x : {0, 125, 127, 128, 131, 255, 258, 269}) {
        const Scene scene = make_scene({270, 16, 24}, [&](glm::ivec3 c) {
            return c.x == x && c.y >= 6 ? MATERIAL_WATER_FULL : MATERIAL_AIR;
        });
        for (const WaterTier tier : {WaterTier::Block, WaterTier::Level}) {
            SCOPED_TRACE(fmt::format("{}, x {}", name_of(tier), x));
            Pair pair(scene);
            pair.step(24, settings_of(tier));
            EXPECT_TRUE(pair.agree());
        }
    }
}

TEST_F(SleepTest, the_springs_of_built_in_scenes_never_sleep) {
    for (const std::string& name : built_in_scenes()) {
        const Scene scene = load_scene(name, Settings{});
        if (scene.springs.empty()) continue;
        SCOPED_TRACE(name);
        Pair pair(scene);
        std::uint64_t sprung = 0;
        for (int round = 0; round < 3; ++round) {
            pair.step(30, scene.settings);
            const std::uint64_t now = pair.simulation().flow_totals().sprung_water_quanta;
            EXPECT_EQ(now, pair.reference().flow().sprung_water_quanta);
            EXPECT_GT(now, sprung + 512);
            sprung = now;
        }
        EXPECT_TRUE(pair.agree());
    }
}

// The stamps of sleeping bricks are ticks: they wrap too.
TEST_F(SleepTest, edits_around_the_tick_counters_wrap_wake) {
    constexpr std::uint64_t wrap = std::uint64_t{1} << 32;
    const auto pool = [](glm::ivec3 c) -> std::uint32_t {
        return c.y < 4 ? MATERIAL_WATER_FULL : MATERIAL_AIR;
    };
    for (const WaterTier tier : tiers)
        for (const int before : {0, 1, 2, SLEEP_TICKS, SLEEP_TICKS + 1, SLEEP_TICKS + 2}) {
            SCOPED_TRACE(fmt::format("{}, {} ticks before", name_of(tier), before));
            const Settings settings = settings_of(tier);
            const std::uint64_t start = wrap - before - SLEEP_TICKS - 1;
            Pair pair(make_scene({18, 12, 14}, pool), start);
            EXPECT_EQ(pair.ticks_to_sleep(100, settings), SLEEP_TICKS + 1);
            ASSERT_EQ(pair.simulation().tick(), wrap - before);
            pair.write({9, 11, 7}, MATERIAL_SAND);
            const int ticks = pair.ticks_to_sleep(400, settings);
            EXPECT_TRUE(tier == WaterTier::Block || (ticks > SLEEP_TICKS && ticks < 400)) << ticks;
            EXPECT_TRUE(pair.agree());
        }
}

struct Rest {
    double mean_vox = 0, deviation_vox = 0;
    std::uint64_t quanta = 0;
};

Rest rest_of(const Cells& cells) {
    const glm::ivec3 size = cells.size_vox();
    double sum = 0;
    double squares = 0;
    for (int z = 0; z < size.z; ++z)
        for (int x = 0; x < size.x; ++x) {
            double height = 0;
            for (int y = 0; y < size.y; ++y) height += quanta_of(cells.at({x, y, z})) / 16.0;
            sum += height;
            squares += height * height;
        }
    const double n = size.x * size.z;
    return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * sum / n)),
            take_census(cells).water_quanta};
}

TEST_F(SleepTest, water_that_slept_lies_as_water_that_did_not) {
    const Scene scene = make_scene({64, 20, 24}, [](glm::ivec3 c) -> std::uint32_t {
        return c.x < 20 && c.y < 16 ? MATERIAL_WATER_FULL : MATERIAL_AIR;
    });
    for (const WaterTier tier : {WaterTier::Level, WaterTier::Pressure}) {
        SCOPED_TRACE(name_of(tier));
        std::array<Rest, 2> rest;
        for (const bool awake : {false, true}) {
            gl::Timers timers;
            Simulation simulation(scene, timers);
            simulation.set_always_awake(awake);
            simulation.step(700, settings_of(tier));
            EXPECT_EQ(simulation.active_bricks() == 0, !awake);
            const Cells cells = simulation.read_cells();
            rest[awake ? 1 : 0] = rest_of(cells);
            simulation.step(100, settings_of(tier));
            EXPECT_TRUE(same_cells(simulation.read_cells(), cells)) << "not at rest";
        }
        EXPECT_EQ(rest[0].quanta, take_census(scene.cells).water_quanta);
        EXPECT_EQ(rest[1].quanta, rest[0].quanta);
        EXPECT_EQ(rest[0].mean_vox, rest[1].mean_vox);
        EXPECT_LE(rest[0].deviation_vox, 0.12);
        EXPECT_NEAR(rest[0].deviation_vox, rest[1].deviation_vox, 0.05);
    }
}

}  // namespace
}  // namespace tarn
