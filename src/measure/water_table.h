// The table of the measured water: each figure over all seeds, beside what it should be. Owns the targets.
#pragma once
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/water_run.h"

namespace tarn {

struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool holds(double value) const { return value >= low && value <= high; }
};

// What a figure should be over all seeds; either may be absent.
struct Target {
    std::optional<Range> typical = {}, worst = {};
};

enum class Verdict { None, Pass, Miss, Bad };  // None: no target; Bad: mass was lost or made

struct WaterRow {
    std::string tier, scenario, figure;
    const char* average = "median";  // what `typical` is: median or mean
    double typical = 0, worst = 0;   // infinity: never
    std::optional<Target> target = {};
    Verdict verdict = Verdict::None;
    std::vector<double> values = {};  // by seed
};

// Nothing where no target is set.
std::optional<Target> water_target(const std::string& tier, const std::string& scenario,
                                   const std::string& figure);

// One row for each (tier, scenario, figure), in the order of the runs. Where a tier ran `dam` and `bigdam`,
// also the exponent by which the time to flatness grows with the length.
std::vector<WaterRow> water_rows(std::span<const WaterRun> runs);

bool any_bad(std::span<const WaterRow> rows);

std::string water_text(std::span<const WaterRow> rows);
// RFC 4180 with a header; never is `inf`.
std::string water_csv(std::span<const WaterRow> rows);
// The level error of each scenario against ticks, a line per tier, of each one's first seed; an SVG.
std::string water_plot(std::span<const WaterRun> runs);

}  // namespace tarn
