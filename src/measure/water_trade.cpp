#include "measure/water_trade.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "measure/water_run.h"

namespace tarn {

namespace {

constexpr std::uint32_t seed = 1;
constexpr int rounds = 5;
constexpr int ticks_of_turn = 8;

struct Rule {
    const char* name;
    std::vector<const char*> set;
};
// What of the water is a setting: its tier, how thin a film stays, how often it moves and its head is swept.
const Rule rules[] = {{"block", {"water_tier=block"}},
                      {"level", {"water_tier=level"}},
                      {"level, film 1", {"water_tier=level", "film_threshold=1"}},
                      {"level, 2 steps", {"water_tier=level", "water_substeps=2"}},
                      {"pressure", {"water_tier=pressure"}},
                      {"pressure, 4 sweeps", {"water_tier=pressure", "pressure_sweeps=4"}},
                      {"pressure, 2 steps", {"water_tier=pressure", "water_substeps=2"}}};

Settings settings_of(const Rule& rule) {
    Settings settings;
    for (const char* assignment : rule.set) set_assignment(settings, assignment);
    return settings;
}

// Of each rule, over the same first ticks of the scenario, in turn.
std::vector<double> tick_times(const WaterScenario& scenario) {
    std::vector<std::vector<double>> ms(std::size(rules));
    for (int round = 0; round < rounds; ++round)
        for (std::size_t r = 0; r < std::size(rules); ++r) {
            const auto stepper =
                make_gpu_stepper(scene_of(scenario, seed), {.settings = settings_of(rules[r])});
            stepper->tick();  // compiles
            const auto start = std::chrono::steady_clock::now();
            for (int i = 0; i < ticks_of_turn; ++i) stepper->tick();
            const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
            ms[r].push_back(taken.count() / ticks_of_turn);
        }
    std::vector<double> medians;
    for (std::vector<double>& of_rule : ms) {
        std::sort(of_rule.begin(), of_rule.end());
        medians.push_back(of_rule[of_rule.size() / 2]);
    }
    return medians;
}

double figure(const WaterRun& run, const std::string& name) {
    for (const Figure& f : run.figures)
        if (f.name == name) return f.value;
    return std::numeric_limits<double>::infinity();
}

std::string tick_text(double tick) {
    return std::isfinite(tick) ? fmt::format("{:.0f}", tick) : std::string("never");
}

}  // namespace

std::vector<WaterTradeRow> measure_water_trade(bool quick,
                                               const std::function<void(const std::string&)>& progress) {
    std::vector<const char*> names = {"dam"};
    if (!quick) names.insert(names.end(), {"spill", "utube", "riser"});
    std::vector<WaterTradeRow> rows;
    for (const char* name : names) {
        const WaterScenario& scenario = *find_water_scenario(name);
        progress(fmt::format("water: {}: times of ticks", name));
        const std::vector<double> ms = tick_times(scenario);
        for (std::size_t r = 0; r < std::size(rules); ++r) {
            progress(fmt::format("water: {}: {}", name, rules[r].name));
            const WaterRun run =
                run_water(scenario, seed, make_gpu_stepper, {.stepper = {.settings = settings_of(rules[r])}});
            WaterTradeRow& row = rows.emplace_back();
            row.rule = rules[r].name;
            row.scenario = name;
            row.tick_ms = ms[r];
            row.rest_from_tick = figure(run, "at_rest_from_tick");
            CHECK(scenario.level);
            row.level_from_tick = figure(run, scenario.level->goal);
            row.curve = run.level_error;
            if (!row.curve.empty()) row.level_error = row.curve.back().y;
        }
    }
    return rows;
}

std::string water_trade_text(std::span<const WaterTradeRow> rows) {
    std::string text = fmt::format("{:<9} {:<18} {:>8} {:>11} {:>10} {:>14} {:>12}\n", "scenario", "rule",
                                   "tick_ms", "level from", "at rest", "level error", "ms to level");
    for (const WaterTradeRow& r : rows)
        text += fmt::format("{:<9} {:<18} {:>8.2f} {:>11} {:>10} {:>10.3f} vox {:>12}\n", r.scenario, r.rule,
                            r.tick_ms, tick_text(r.level_from_tick), tick_text(r.rest_from_tick),
                            r.level_error, tick_text(r.level_from_tick * r.tick_ms));
    return text;
}

std::string water_trade_csv(std::span<const WaterTradeRow> rows) {
    std::string text = "scenario,rule,tick_ms,level_from_tick,rest_from_tick,level_error_vox\n";
    for (const WaterTradeRow& r : rows)
        text += fmt::format("{},\"{}\",{},{},{},{}\n", r.scenario, r.rule, r.tick_ms, r.level_from_tick,
                            r.rest_from_tick, r.level_error);
    return text;
}

Drawing draw_water_trade(std::span<const WaterTradeRow> rows) {
    std::vector<PlotPanel> panels;
    for (const WaterTradeRow& row : rows) {
        if (panels.empty() || panels.back().title != row.scenario)
            panels.push_back({.title = row.scenario,
                              .x = {.label = "milliseconds of ticks"},
                              .y = {.label = "level error, voxels", .log = true, .low = lowest_error_vox}});
        PlotSeries series{.name = row.rule};
        for (const glm::dvec2& point : row.curve) series.points.push_back({point.x * row.tick_ms, point.y});
        panels.back().series.push_back(series);
    }
    return draw_plot(panels, 2, "Water: how far from level, against what its ticks cost", {560, 340});
}

}  // namespace tarn
