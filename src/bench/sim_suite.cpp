// Ticks of the terrain's world: all of it awake, a tenth of it, none; beside them the CPU's tick of all, a
// small world at rest, and a copy of the bytes as the floor.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "app/stopwatch.h"
#include "bench/bench_suites.h"
#include "bench/cpu_step.h"
#include "passes/bricks.h"
#include "shared/bindings.h"

namespace tarn {

namespace {

constexpr int ticks_a_sample = 2;
constexpr int ticks_a_sample_asleep = 32;
constexpr int small_side_vox = 64;

double tick_ms(BenchWorld& world, int ticks) {
    const Settings& settings = world.scene.settings;
    glFinish();
    const Stopwatch watch;
    for (int i = 0; i < ticks; ++i) world.simulation.step(1, settings);
    glFinish();
    const double ms = watch.ms() / ticks;
    world.timers.end_frame();
    world.timers.finish();
    return ms;
}

// One cell of every brick in a tenth of the world, from x = 0, becomes another solid: it moves nothing and
// wakes the brick.
void wake_a_tenth(BenchWorld& world) {
    const glm::ivec3 bricks = bricks_of(world.simulation.size_vox());
    const int end_x = std::max(1, bricks.x / 10);
    const Cells cells = world.simulation.read_cells();
    std::vector<CellChange> changes;
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < end_x; ++x) {
                const glm::ivec3 cell = glm::ivec3(x, y, z) * BRICK_SIDE;
                const std::uint8_t before = cells.at(cell);
                changes.push_back({cell, before, before == MATERIAL_STONE ? MATERIAL_DIRT : MATERIAL_STONE});
            }
    world.simulation.write(changes);
    world.timers.end_frame();
    world.timers.finish();
}

// By every thread, a part each.
double copy_ms(const std::vector<std::uint8_t>& from, std::vector<std::uint8_t>& to, int threads) {
    const std::size_t part = from.size() / static_cast<std::size_t>(threads);
    const Stopwatch watch;
    std::vector<std::thread> workers;
    for (int i = 0; i < threads; ++i) {
        const std::size_t first = part * static_cast<std::size_t>(i);
        const std::size_t count = i + 1 == threads ? from.size() - first : part;
        workers.emplace_back(
            [&, first, count] { std::memcpy(to.data() + first, from.data() + first, count); });
    }
    for (std::thread& worker : workers) worker.join();
    return watch.ms();
}

// Ticks of the tier `block` with all awake; leaves the world to the scene's own tier.
double block_tick_ms(BenchWorld& world, int ticks) {
    const Settings own = world.scene.settings;
    world.scene.settings.water_tier = WaterTier::Block;
    // Another tier wakes all, which costs more than a tick.
    world.simulation.step(1, world.scene.settings);
    const double ms = tick_ms(world, ticks);
    world.scene.settings = own;
    world.simulation.step(1, own);
    return ms;
}

// Ticks of a world of its own, from the scene's start as the GPU's is.
class CpuTicks {
  public:
    using Tick = void (*)(Cells&, std::uint32_t tick, const CpuStep&);
    CpuTicks(const BenchWorld& world, Tick run, int threads, CpuVectors vectors)
        : run_(run),
          cells_(world.scene.cells),
          step_{.seed = world.scene.seed,
                .film_threshold = world.scene.settings.film_threshold,
                .threads = threads,
                .vectors = vectors} {}
    double ms(int ticks) {
        const Stopwatch watch;
        for (int i = 0; i < ticks; ++i) run_(cells_, tick_++, step_);
        return watch.ms() / ticks;
    }

  private:
    Tick run_;
    Cells cells_;
    CpuStep step_;
    std::uint32_t tick_ = 0;
};

void measure_world(int side_vox, const BenchOptions& options, BenchResult& result) {
    const std::string scene = bench_scene_name(side_vox);
    options.progress(fmt::format("sim: building {}", scene));
    const auto world = make_bench_world(side_vox);
    const bool has_avx2 = has_vectors(CpuVectors::Avx2);
    const CpuVectors best = has_avx2 ? CpuVectors::Avx2 : CpuVectors::Plain;
    CpuTicks level(*world, cpu_level_tick, options.threads, best);
    CpuTicks level_plain(*world, cpu_level_tick, options.threads, CpuVectors::Plain);
    CpuTicks block(*world, cpu_block_tick, options.threads, best);
    const auto small = side_vox > small_side_vox ? make_bench_world(small_side_vox) : nullptr;
    std::vector<std::uint8_t> copy(world->scene.cells.count());
    std::vector<Contestant> contestants;
    const auto add = [&](const char* who, std::function<std::vector<Sample>()> run) {
        contestants.push_back({.suite = "sim", .scene = scene, .who = who, .run = std::move(run)});
    };
    const auto ticks = [&](int count) {
        const double ms = tick_ms(*world, count);
        return std::vector<Sample>{
            {"tick", "ms", ms},
            {"active bricks", "bricks", static_cast<double>(world->simulation.active_bricks())}};
    };
    add("awake", [&] {
        world->simulation.set_tick(world->simulation.tick());  // wakes all
        return ticks(ticks_a_sample);
    });
    add("tenth", [&] {
        world->simulation.put_to_sleep();
        wake_a_tenth(*world);
        return ticks(ticks_a_sample);
    });
    add("asleep", [&] {
        world->simulation.put_to_sleep();
        return ticks(ticks_a_sample_asleep);
    });
    if (small) {
        contestants.push_back(
            {.suite = "sim", .scene = scene, .who = "asleep 64^3", .run = [&] {
                 small->simulation.put_to_sleep();
                 return std::vector<Sample>{{"tick", "ms", tick_ms(*small, ticks_a_sample_asleep)}};
             }});
    }
    const auto add_cpu = [&](const char* who, CpuTicks& cpu) {
        add(who, [&] { return std::vector<Sample>{{"tick", "ms", cpu.ms(ticks_a_sample)}}; });
    };
    add_cpu("cpu awake", level);
    if (has_avx2) add_cpu("cpu awake without AVX2", level_plain);
    add("awake block", [&] {
        return std::vector<Sample>{{"tick", "ms", block_tick_ms(*world, ticks_a_sample)}};
    });
    add_cpu("cpu awake block", block);
    add("copy", [&] {
        const double ms = copy_ms(world->scene.cells.bytes(), copy, options.threads);
        return std::vector<Sample>{{"cells", "ms", ms}};
    });
    run_rounds(contestants, {.rounds = options.rounds, .budget_ms = 8000}, result.figures, options.progress);
}

}  // namespace

void run_sim_suite(const BenchOptions& options, BenchResult& result) {
    for (const int side : options.sides_vox) measure_world(side, options, result);
}

}  // namespace tarn
