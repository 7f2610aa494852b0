#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "measure/svg_plot.h"
#include "measure/water_run.h"
#include "measure/water_table.h"

namespace tarn {

namespace {

constexpr int panel_columns = 3;

PlotPanel& panel_of(std::vector<PlotPanel>& panels, const WaterRun& run) {
    const auto found = std::find_if(panels.begin(), panels.end(),
                                    [&](const PlotPanel& panel) { return panel.title == run.scenario; });
    if (found != panels.end()) return *found;
    panels.push_back({.title = run.scenario,
                      .x = {.label = "ticks"},
                      .y = {.label = run.level_axis, .log = true, .low = lowest_error_vox},
                      .levels = {{run.level_limit, fmt::format("{:g}", run.level_limit)}}});
    return panels.back();
}

}  // namespace

std::string water_plot(std::span<const WaterRun> runs) {
    std::vector<PlotPanel> panels;
    for (const WaterRun& run : runs) {
        if (run.level_error.empty()) continue;
        PlotPanel& panel = panel_of(panels, run);
        const auto drawn = [&](const PlotSeries& series) { return series.name == run.tier; };
        if (std::any_of(panel.series.begin(), panel.series.end(), drawn)) continue;
        panel.series.push_back({.name = run.tier, .points = run.level_error});
    }
    return svg_plot(panels, panel_columns,
                    "How far water is from level, against ticks; a line per tier, the first seed of each");
}

}  // namespace tarn
