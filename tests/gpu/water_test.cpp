// The water's step on the GPU equals the serial reference in every byte, whatever the world holds.
#include <gtest/gtest.h>

#include "app/simulation.h"
#include "gpu/gl_test.h"
#include "gpu/worlds.h"
#include "reference/water_block.h"

namespace tarn {
namespace {

using WaterTest = GlTest;

void expect_equal_steps(glm::ivec3 size_vox, Soup soup, std::uint32_t seed, std::uint64_t first_tick,
                        int ticks, int ticks_between_looks, int film_threshold) {
    SCOPED_TRACE(fmt::format("size {}x{}x{}, soup {}, seed {}, from tick {}, film {}", size_vox.x, size_vox.y,
                             size_vox.z, static_cast<int>(soup), seed, first_tick, film_threshold));
    Scene scene;
    scene.seed = seed;
    scene.cells = make_soup(size_vox, soup, seed * 977 + 13);
    Settings settings;
    settings.film_threshold = film_threshold;
    gl::Timers timers;
    Simulation simulation(scene, timers);
    simulation.set_tick(first_tick);
    Cells reference = scene.cells;
    for (int done = 0; done < ticks; done += ticks_between_looks) {
        simulation.step(ticks_between_looks, settings);
        for (int i = 0; i < ticks_between_looks; ++i)
            water_block_tick(reference, seed, static_cast<std::uint32_t>(first_tick + done + i),
                             film_threshold);
        ASSERT_TRUE(same_cells(simulation.read_cells(), reference))
            << "after tick " << first_tick + done + ticks_between_looks - 1;
    }
    EXPECT_EQ(simulation.tick(), first_tick + ticks);
    EXPECT_EQ(take_census(reference).water_quanta, take_census(scene.cells).water_quanta);
    EXPECT_EQ(take_census(reference).voxels[MATERIAL_SAND], take_census(scene.cells).voxels[MATERIAL_SAND]);
}

TEST_F(WaterTest, equals_reference_for_odd_sizes_and_seeds) {
    for (const glm::ivec3 size : {glm::ivec3(1, 1, 1), glm::ivec3(2, 2, 2), glm::ivec3(7, 13, 5),
                                  glm::ivec3(1, 40, 1), glm::ivec3(61, 37, 45)})
        for (const Soup soup : {Soup::AllBytes, Soup::Matter, Soup::Water, Soup::Layers}) {
            const bool large = size.x > 32;
            for (const std::uint32_t seed : {1u, 77u, 0xffffffffu}) {
                if (large && seed == 77u) continue;
                expect_equal_steps(size, soup, seed, 0, large ? 100 : 200, large ? 20 : 5, 3);
                if (HasFatalFailure()) return;
            }
        }
}

TEST_F(WaterTest, equals_reference_for_hundreds_of_ticks) {
    expect_equal_steps({64, 48, 64}, Soup::Layers, 5, 1000, 300, 60, 3);
}

TEST_F(WaterTest, equals_reference_across_the_tick_counters_wrap) {
    constexpr std::uint64_t wrap = std::uint64_t{1} << 32;
    for (const Soup soup : {Soup::Matter, Soup::Water}) {
        expect_equal_steps({7, 13, 5}, soup, 3, wrap - 50, 100, 1, 3);
        expect_equal_steps({21, 16, 19}, soup, 3, (wrap << 7) - 7, 20, 1, 3);
    }
}

TEST_F(WaterTest, equals_reference_for_every_film_threshold) {
    for (const int film : {1, 2, 5, 16}) expect_equal_steps({19, 12, 23}, Soup::Water, 9, 0, 60, 10, film);
}

TEST_F(WaterTest, same_seed_gives_the_same_bytes_and_another_does_not) {
    const auto run = [](std::uint32_t seed) {
        Scene scene;
        scene.seed = seed;
        scene.cells = make_soup({24, 24, 24}, Soup::Matter, 4);
        gl::Timers timers;
        Simulation simulation(scene, timers);
        simulation.step(50, Settings{});
        return hash_of(simulation.read_cells());
    };
    EXPECT_EQ(run(1), run(1));
    EXPECT_NE(run(1), run(2));
}

// What a player sees: a basin fills its holes, nothing hangs in the air, sand lies below water.
TEST_F(WaterTest, water_falls_into_shafts_and_sand_sinks) {
    Scene scene;
    scene.cells = Cells({24, 24, 24});
    for (int z = 0; z < 24; ++z)
        for (int x = 0; x < 24; ++x)
            for (int y = 0; y < 24; ++y)
                scene.cells.at({x, y, z}) = y < 8                        ? MATERIAL_STONE
                                            : y < 12                     ? std::uint8_t{MATERIAL_WATER_FULL}
                                            : y == 20 && x > 8 && x < 12 ? MATERIAL_SAND
                                                                         : MATERIAL_AIR;
    for (int y = 0; y < 8; ++y) scene.cells.at({3, y, 17}) = MATERIAL_AIR;
    gl::Timers timers;
    Simulation simulation(scene, timers);
    simulation.step(200, Settings{});
    const Cells cells = simulation.read_cells();
    for (int y = 0; y < 8; ++y) EXPECT_EQ(cells.at({3, y, 17}), MATERIAL_WATER_FULL) << y;
    for (int z = 0; z < 24; ++z)
        for (int x = 0; x < 24; ++x)
            for (int y = 1; y < 24; ++y) {
                if (cells.at({x, y, z}) != MATERIAL_SAND) continue;
                const std::uint8_t below = cells.at({x, y - 1, z});
                EXPECT_TRUE(below == MATERIAL_STONE || below == MATERIAL_SAND) << x << ' ' << y << ' ' << z;
            }
}

}  // namespace
}  // namespace tarn
