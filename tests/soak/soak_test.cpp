// The long runs, by their own command: ctest -C soak -L soak. Of conservation_test: 10,000 ticks of every
// built-in scene, a minute or so a scene without a GPU; and 10,000 beside the CPU reference. Of
// extremes_history_test: a million frames of exact mode's mean.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "gpu/accumulator.h"
#include "gpu/conservation.h"
#include "gpu/gl_test.h"
#include "gpu/worlds.h"
#include "reference/simulation.h"

namespace tarn {
namespace {

using SoakTest = GlTest;

TEST_F(SoakTest, every_scene_keeps_its_water_and_sand_for_10000_ticks) {
    for (const std::string& name : built_in_scenes()) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(name, Settings{});
        gl::Timers timers;
        Simulation simulation(scene, timers);
        const Census initial = take_census(scene.cells);
        expect_kept_books(simulation, scene.settings, initial, 10000, 50);
        if (HasFatalFailure()) return;
        const Census now = take_census(simulation.read_cells());
        const FlowTotals flow = simulation.flow_totals();
        fmt::print("{:10} tick {}: water {} = {} + {} sprung - {} drained; sand {} = {} + {} - {}\n", name,
                   simulation.tick(), now.water_quanta, initial.water_quanta, flow.sprung_water_quanta,
                   flow.drained_water_quanta, now.voxels[MATERIAL_SAND], initial.voxels[MATERIAL_SAND],
                   flow.sprung_sand_voxels, flow.drained_sand_voxels);
        std::fflush(stdout);
    }
}

// Up to a thousand ticks: what scenes_test leaves out.
TEST_F(SoakTest, the_other_scenes_without_a_spring_come_to_rest_under_pressure) {
    for (const std::string& name : built_in_scenes()) {
        const Scene scene = load_scene(name, Settings{});
        if (!scene.springs.empty() || rests_early_under_pressure(name)) continue;
        SCOPED_TRACE(name);
        expect_rest(scene, WaterTier::Pressure, 1500);
    }
}

// Asleep or awake, as the scene would have it: seconds where it comes to rest, ten minutes or so where a
// spring runs on, most of them the reference's.
class SceneSoakTest : public GlTest, public testing::WithParamInterface<std::string> {};

TEST_P(SceneSoakTest, equals_the_reference_for_10000_ticks) {
    const Scene scene = load_scene(GetParam(), Settings{});
    gl::Timers timers;
    Simulation simulation(scene, timers);
    reference::Simulation reference(scene, 0);
    const auto start = std::chrono::steady_clock::now();
    for (int tick = 0; tick < 10000; tick += 100) {
        simulation.step(100, scene.settings);
        reference.step(100, scene.settings);
        ASSERT_TRUE(same_cells(simulation.read_cells(), reference.cells())) << "tick " << tick + 100;
        timers.end_frame();
    }
    const FlowTotals flow = simulation.flow_totals();
    EXPECT_EQ(flow.sprung_water_quanta, reference.flow().sprung_water_quanta);
    EXPECT_EQ(flow.drained_water_quanta, reference.flow().drained_water_quanta);
    fmt::print("{:10} tick {}: {} bricks active (reference {}), {:.0f} s\n", GetParam(), simulation.tick(),
               simulation.active_bricks(), reference.active_bricks(),
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    std::fflush(stdout);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, SceneSoakTest, testing::ValuesIn(built_in_scenes()), [](const auto& scene) {
    std::string name = scene.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST_F(SoakTest, a_mean_of_a_million_frames_is_their_mean) {
    const NoisyFrames frames;
    Accumulator sums;
    std::vector<glm::dvec3> total(Accumulator::pixels, glm::dvec3(0));
    constexpr std::uint32_t count = 1u << 20;
    for (std::uint32_t k = 0; k < count; ++k) {
        sums.add(frames.texture(k));
        for (int i = 0; i < Accumulator::pixels; ++i) total[i] += frames.value_of(k, i);
    }
    const Accumulator::Values mean = sums.mean();
    double worst = 0;
    double worst_variance = 0;
    for (int i = 0; i < Accumulator::pixels; ++i) {
        double deviations = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 d = frames.value_of(k, i) - total[i] / static_cast<double>(count);
            deviations += std::pow(glm::dot(d, glm::dvec3(0.2126, 0.7152, 0.0722)), 2) / 3;
        }
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(mean[i][c] / (total[i][c] / count) - 1));
        worst_variance = std::max(worst_variance, std::abs(sums.variance(i) / deviations - 1));
    }
    fmt::print("{} frames: the mean is off by {:.1e} of itself, the variance by {:.1e}\n", count, worst,
               worst_variance);
    // Two roundings to float32: of the sum with its correction, and of the quotient.
    EXPECT_LE(worst, 1.2e-7);
    // The three frames come up equally often but for one; deviations are from a float32 mean.
    EXPECT_LE(worst_variance, 5e-6);
    EXPECT_EQ(sums.rejected(), 0u);
}

}  // namespace
}  // namespace tarn
