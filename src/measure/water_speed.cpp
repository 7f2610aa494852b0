#include "measure/water_speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "core/settings.h"
#include "shared/water.h"

namespace tarn {

namespace {

constexpr int timed_ticks = 4;
constexpr int moving_after_ticks = 8;
// The serial reference is timed in worlds up to this side.
constexpr int reference_side_max = 128;

Scene pool(int side_vox, bool dam) {
    Scene scene;
    scene.cells = Cells(glm::ivec3(side_vox));
    for (int z = 0; z < side_vox; ++z)
        for (int y = 0; y < side_vox / 2; ++y)
            for (int x = 0; x < (dam ? side_vox / 2 : side_vox); ++x)
                scene.cells.at({x, y, z}) = MATERIAL_WATER_FULL;
    return scene;
}

double quanta_moved(const Cells& before, const Cells& after) {
    double moved = 0;
    for (std::size_t i = 0; i < before.bytes().size(); ++i)
        moved += std::abs(static_cast<int>(quanta_of(before.bytes()[i])) -
                          static_cast<int>(quanta_of(after.bytes()[i])));
    return moved / 2;
}

struct Case {
    SpeedRow row;
    std::unique_ptr<WaterStepper> stepper;
    std::vector<double> ms;
    double moved = 0;
};

void time_ticks(Case& c) {
    for (int i = 0; i < timed_ticks; ++i) {
        const Cells before = c.stepper->read();
        const auto start = std::chrono::steady_clock::now();
        c.stepper->tick();
        c.ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        c.moved += quanta_moved(before, c.stepper->read());
    }
}

}  // namespace

std::vector<SpeedRow> measure_water_speed(const std::vector<std::string>& tiers,
                                          const std::vector<int>& sides_vox, int rounds,
                                          const std::function<void(double)>& progress) {
    std::vector<SpeedRow> rows;
    int done = 0;
    const int all = static_cast<int>(sides_vox.size()) * 3;
    for (const int side : sides_vox)
        for (const char* state : {"moving", "awake", "asleep"}) {
            std::vector<Case> cases;
            for (const std::string& tier : tiers)
                for (const bool gpu : {true, false}) {
                    if (!gpu && side > reference_side_max) continue;
                    StepperOptions options;
                    set_setting(options.settings, "water_tier", tier);
                    options.awake = std::string_view(state) == "awake";
                    const Scene scene = pool(side, std::string_view(state) == "moving");
                    Case& c = cases.emplace_back();
                    c.row = {
                        .tier = tier, .stepper = gpu ? "gpu" : "reference", .state = state, .side_vox = side};
                    c.stepper =
                        gpu ? make_gpu_stepper(scene, options) : make_reference_stepper(scene, options);
                    const int before =
                        std::string_view(state) == "asleep" ? SLEEP_TICKS + 1 : moving_after_ticks;
                    for (int i = 0; i < before; ++i) c.stepper->tick();
                }
            for (int round = 0; round < rounds; ++round)
                for (Case& c : cases) time_ticks(c);
            for (Case& c : cases) {
                std::sort(c.ms.begin(), c.ms.end());
                c.row.tick_ms = c.ms[c.ms.size() / 2];
                c.row.quanta_moved_per_tick = c.moved / static_cast<double>(c.ms.size());
                rows.push_back(c.row);
            }
            progress(static_cast<double>(++done) / all);
        }
    return rows;
}

std::string speed_text(const std::vector<SpeedRow>& rows) {
    std::string text =
        fmt::format("{:>5} {:<7} {:<9} {:<10} {:>10} {:>10} {:>12} {:>14} {:>16}\n", "side", "state", "tier",
                    "stepper", "tick_ms", "ticks_s", "ns_per_cell", "quanta_per_tick", "ns_per_quantum");
    for (const SpeedRow& row : rows) {
        const double cells = static_cast<double>(row.side_vox) * row.side_vox * row.side_vox;
        const std::string per_quantum =
            row.quanta_moved_per_tick > 0
                ? fmt::format("{:.1f}", row.tick_ms * 1e6 / row.quanta_moved_per_tick)
                : std::string("-");
        text += fmt::format("{:>5} {:<7} {:<9} {:<10} {:>10.3f} {:>10.1f} {:>12.2f} {:>15.0f} {:>16}\n",
                            row.side_vox, row.state, row.tier, row.stepper, row.tick_ms, 1000 / row.tick_ms,
                            row.tick_ms * 1e6 / cells, row.quanta_moved_per_tick, per_quantum);
    }
    return text;
}

std::string speed_csv(const std::vector<SpeedRow>& rows) {
    std::string text = "side_vox,state,tier,stepper,tick_ms,quanta_moved_per_tick\n";
    for (const SpeedRow& row : rows)
        text += fmt::format("{},{},{},{},{},{}\n", row.side_vox, row.state, row.tier, row.stepper,
                            row.tick_ms, row.quanta_moved_per_tick);
    return text;
}

}  // namespace tarn
