// What the figures must reach: ratios of things measured in one run, each with its bar beside it.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/figures.h"

namespace tarn {

struct BarRow {
    std::string what;
    std::optional<double> value;  // nothing where the run does not hold both sides
    double at_least, reach_for;   // limits from below, or from above where less is better
    bool more_is_better;

    bool met() const { return value && (more_is_better ? *value >= at_least : *value <= at_least); }
    bool reached() const { return value && (more_is_better ? *value >= reach_for : *value <= reach_for); }
};

std::vector<BarRow> bar_rows(std::span<const BenchFigure> figures);
std::string bars_text(std::span<const BarRow> rows);

}  // namespace tarn
