// Charts of the measured trade.
#pragma once
#include <span>
#include <string>

#include "measure/svg_plot.h"
#include "measure/tradeoff_table.h"

namespace tarn {

// A panel for each recording of `scene`: time against error, the front, the qualities.
Drawing draw_scene(std::span<const TradeoffRow> rows, const std::string& scene, const std::string& about);

// All scenes and recordings in one.
Drawing draw_over_all(std::span<const TradeoffRow> rows, const std::string& about);

}  // namespace tarn
