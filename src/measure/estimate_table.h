// The overlay's estimate of the error beside the true one: rows, a chart, and the factor between them.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "measure/svg_plot.h"
#include "measure/tradeoff_table.h"

namespace tarn {

struct EstimateRow {
    std::string scene, label;  // label: what made the picture
    int samples = 0;           // of exact mode; 0: another quality
    double predicted = 0, error = 0, floor = 0;
};

// What the rows of the trade say of the qualities that have an estimate.
std::vector<EstimateRow> estimate_rows(std::span<const TradeoffRow> rows);

std::string estimate_csv(std::span<const EstimateRow> rows);
// The true error over the predicted one: geometric mean and extremes, of exact mode and of the others; rows
// near their floor are left out.
std::string estimate_text(std::span<const EstimateRow> rows);
Drawing draw_estimates(std::span<const EstimateRow> rows);

}  // namespace tarn
