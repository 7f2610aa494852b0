#include "measure/water_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "measure/water_metrics.h"

namespace tarn {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
// Ticks left out of the mean time: shaders compile and caches fill in them.
constexpr int warm_up_ticks = 8;
// Stepped on after rest is found, so that what sleeps by then is asleep when the active bricks are counted.
constexpr int ticks_after_rest = 4;

double tick_or_never(std::optional<int> tick) {
    return tick ? static_cast<double>(*tick) : never;
}

// The world's bytes between ticks, and what is kept of every tick.
class Run {
  public:
    Run(const WaterScenario& scenario, std::uint32_t seed, const MakeStepper& make,
        const WaterRunOptions& options)
        : scenario_(scenario), options_(options) {
        const Scene scene = scene_of(scenario, seed);
        cells_ = scene.cells;
        expected_ = mass_of(cells_);
        stepper_ = make(scene, options.stepper);
    }

    // Until rest or the last tick; ticks count from 0.
    void phase() {
        held_ = {};
        unchanged_ = {};
        settled_.reset();
        level_error_.clear();
        worst_false_head_ = 0;
        const int tap_ticks = scenario_.tap ? scenario_.tap->ticks : 0;
        const int quiet = quiet_ticks(options_.stepper.settings.water_tier);
        const int last = options_.ticks_limit > 0 ? std::min(options_.ticks_limit, scenario_.ticks_max)
                                                  : scenario_.ticks_max;
        int end = last;
        for (int tick = 0; tick < end; ++tick) {
            if (tick < tap_ticks) pour();
            step(tick);
            if (!settled_ && unchanged_.ticks() >= quiet && tick > tap_ticks) {
                settled_ = unchanged_.since();
                end = std::min(last, tick + 1 + ticks_after_rest);
            }
            if (options_.progress) options_.progress(ticks_);
        }
    }

    void open(const Box& box) {
        change(
            box, [](std::uint8_t byte) { return byte != MATERIAL_AIR; }, MATERIAL_AIR);
    }

    std::vector<Figure> figures() const {
        std::vector<Figure> figures;
        if (scenario_.level) {
            figures.push_back({scenario_.level->goal, tick_or_never(held_.since())});
            if (scenario_.level->false_head) figures.push_back({"false_head_vox", worst_false_head_});
        }
        figures.push_back({"at_rest_from_tick", tick_or_never(settled_)});
        const std::vector<Figure> at_end = scenario_.at_end(cells_);
        figures.insert(figures.end(), at_end.begin(), at_end.end());
        figures.push_back({"ticks", static_cast<double>(ticks_)});
        if (timed_ticks_ > 0) figures.push_back({"ms_per_tick", timed_ms_ / timed_ticks_});
        if (ticks_ > 0)
            figures.push_back({"quanta_moved_per_tick", static_cast<double>(moved_quanta_) / ticks_});
        figures.push_back({"hanging_cells", static_cast<double>(hanging_water(cells_))});
        if (const auto active = stepper_->active_bricks())
            figures.push_back({"active_bricks", *active * 1.0});
        figures.push_back({"mass_off", mass_off_});
        return figures;
    }

    std::optional<int> settled() const { return settled_; }
    const std::vector<glm::dvec2>& level_error() const { return level_error_; }

  private:
    void step(int tick) {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        stepper_->tick();
        const std::chrono::duration<double, std::milli> took = Clock::now() - start;
        if (ticks_++ >= warm_up_ticks) {
            timed_ms_ += took.count();
            ++timed_ticks_;
        }
        Cells now = stepper_->read();
        const CellsDifference done = difference(cells_, now);
        cells_ = std::move(now);
        moved_quanta_ += done.moved_quanta;
        unchanged_.look(tick, done.changed_cells == 0);
        if (done.changed_cells > 0) check_mass();
        if (scenario_.level) {
            const double value = scenario_.level->value(cells_);
            held_.look(tick, scenario_.level->good(value));
            worst_false_head_ = std::max(worst_false_head_, -value);
            level_error_.push_back({tick, std::abs(value)});
        }
    }

    void check_mass() {
        const Mass mass = mass_of(cells_);
        const auto off = [](std::uint64_t a, std::uint64_t b) {
            return static_cast<double>(a > b ? a - b : b - a);
        };
        mass_off_ = std::max(mass_off_, off(mass.water_quanta, expected_.water_quanta) +
                                            off(mass.sand_voxels, expected_.sand_voxels));
    }

    template <typename Condition>
    void change(const Box& box, const Condition& wanted, std::uint8_t byte) {
        std::vector<CellChange> changes;
        for (int z = box.min_vox.z; z < box.max_vox.z; ++z)
            for (int y = box.min_vox.y; y < box.max_vox.y; ++y)
                for (int x = box.min_vox.x; x < box.max_vox.x; ++x) {
                    std::uint8_t& cell = cells_.at({x, y, z});
                    if (!wanted(cell)) continue;
                    expected_.water_quanta += quanta_of(byte);
                    expected_.water_quanta -= quanta_of(cell);
                    expected_.sand_voxels -= cell == MATERIAL_SAND;
                    changes.push_back({{x, y, z}, cell, byte});
                    cell = byte;
                }
        stepper_->write(changes);
    }

    void pour() {
        change(
            scenario_.tap->region, [](std::uint8_t byte) { return byte == MATERIAL_AIR; },
            MATERIAL_WATER_FULL);
    }

    const WaterScenario& scenario_;
    const WaterRunOptions& options_;
    std::unique_ptr<WaterStepper> stepper_;
    Cells cells_;
    Mass expected_;
    HeldSince held_, unchanged_;
    std::optional<int> settled_;
    std::vector<glm::dvec2> level_error_;
    double worst_false_head_ = 0, mass_off_ = 0, timed_ms_ = 0;
    std::uint64_t moved_quanta_ = 0;
    int ticks_ = 0, timed_ticks_ = 0;
};

}  // namespace

int quiet_ticks(WaterTier tier) {
    // In `pressure` a head is built anew every 32 ticks and acts for as many.
    constexpr int field_ticks = 32;
    const std::string_view name = choice_names<WaterTier>()[static_cast<std::size_t>(tier)];
    return name == "pressure" ? 64 + 2 * field_ticks : 64;
}

WaterRun run_water(const WaterScenario& scenario, std::uint32_t seed, const MakeStepper& make,
                   const WaterRunOptions& options) {
    Run run(scenario, seed, make, options);
    WaterRun result{
        .tier = choice_names<WaterTier>()[static_cast<std::size_t>(options.stepper.settings.water_tier)],
        .scenario = scenario.name,
        .seed = seed};
    run.phase();
    if (scenario.opening) {
        result.figures.push_back({"closed_rest_from_tick", tick_or_never(run.settled())});
        run.open(*scenario.opening);
        run.phase();
    }
    const std::vector<Figure> figures = run.figures();
    result.figures.insert(result.figures.end(), figures.begin(), figures.end());
    result.level_error = run.level_error();
    if (scenario.level) {
        result.level_axis = scenario.level->axis;
        result.level_limit = scenario.level->limit;
    }
    return result;
}

}  // namespace tarn
