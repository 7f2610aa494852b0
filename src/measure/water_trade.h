// The water's trade of speed for accuracy: each rule's cost of a tick against how level its water gets and
// how soon it rests.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "measure/svg_plot.h"

namespace tarn {

struct WaterTradeRow {
    std::string rule;      // the tier, and settings that differ from the defaults
    std::string scenario;  // of `tarn water`
    double tick_ms = 0;    // median, all rules in turn, over the scenario's first ticks
    double level_from_tick = 0, rest_from_tick = 0;  // infinity: never
    double level_error = 0;                          // at the end, in voxels
    std::vector<glm::dvec2> curve;                   // (tick, level error)
};

// quick: one scenario. Needs a current context. `progress`: what is under way.
std::vector<WaterTradeRow> measure_water_trade(bool quick,
                                               const std::function<void(const std::string&)>& progress);

std::string water_trade_text(std::span<const WaterTradeRow> rows);
std::string water_trade_csv(std::span<const WaterTradeRow> rows);
// A panel for each scenario: the level error against the milliseconds that its ticks took.
Drawing draw_water_trade(std::span<const WaterTradeRow> rows);

}  // namespace tarn
