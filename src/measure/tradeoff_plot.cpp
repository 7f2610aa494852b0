#include "measure/tradeoff_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tarn {

namespace {

constexpr int plots_across = 3;

glm::dvec2 point_of(const Measured& m) {
    return {m.time, m.error > 0 ? m.error : std::nan("")};
}

bool is_quality(const Measured& m, Quality quality) {
    return m.configuration == configuration_of(quality);
}

bool is_baseline(const Measured& m) {
    return std::any_of(std::begin(baseline_samples), std::end(baseline_samples),
                       [&](int samples) { return m.configuration == baseline_with(samples); });
}

// `baseline` is drawn while it errs by at most so many times the worst of the others: the front would shrink
// to a line.
constexpr double baseline_room = 10;

// The front's points are named by letters, which the text beside the chart explains.
PlotPanel panel_of(const std::string& title, const std::string& time_label,
                   const std::vector<Measured>& measured) {
    PlotPanel panel{.title = title,
                    .x = {.label = time_label, .log = true, .low = 1e30, .high = 0},
                    .y = {.label = "relMSE", .log = true, .low = 1e30, .high = 0}};
    double worst = 0;
    for (const Measured& m : measured)
        if (!is_baseline(m)) worst = std::max(worst, m.error);
    bool all_baselines = true;
    for (const Measured& m : measured) {
        if (m.error <= 0) continue;
        if (is_baseline(m) && worst > 0 && m.error > baseline_room * worst) {
            all_baselines = false;
            continue;
        }
        panel.x.low = std::min(panel.x.low, m.time / 1.3);
        panel.x.high = std::max(panel.x.high, m.time);
        panel.y.low = std::min(panel.y.low, m.error / 1.3);
        panel.y.high = std::max(panel.y.high, m.error);
    }
    if (panel.x.high <= panel.x.low || panel.y.high <= panel.y.low) {
        panel.x.low = panel.y.low = 0.1;
        panel.x.high = panel.y.high = 1;
    }
    PlotSeries all{.name = "measured", .line = false, .dots = true, .dot_radius = 1.8};
    PlotSeries front{.name = "Pareto front", .dots = true};
    PlotSeries qualities{.name = "qualities",
                         .line = false,
                         .dots = true,
                         .labels_below = true,
                         .dot_radius = 5,
                         .filled = false};
    PlotSeries baseline{.name = "baseline, 1 to 16 samples", .dots = true};
    for (const Measured& m : measured)
        if (all_baselines || !is_baseline(m)) all.points.push_back(point_of(m));
    const auto on_front = pareto_front(measured);
    for (std::size_t i = 0; i < on_front.size(); ++i) {
        front.points.push_back(point_of(measured[on_front[i]]));
        front.labels.push_back(front_letter(i));
    }
    for (const Quality quality : {Quality::Fast, Quality::Balanced, Quality::Quality})
        for (const Measured& m : measured)
            if (is_quality(m, quality)) {
                qualities.points.push_back(point_of(m));
                qualities.labels.emplace_back(choice_names<Quality>()[static_cast<std::size_t>(quality)]);
            }
    for (const int samples : baseline_samples)
        for (const Measured& m : measured)
            if (m.configuration == baseline_with(samples) && samples == 1 && !all_baselines)
                panel.title += fmt::format("; baseline: {:.3g} at {:.4g}", m.error, m.time);
            else if (m.configuration == baseline_with(samples) && all_baselines) {
                baseline.points.push_back(point_of(m));
                baseline.labels.push_back(samples == 1 ? "baseline" : fmt::format("{}", samples));
            }
    panel.series = {all, front, qualities, baseline};
    return panel;
}

}  // namespace

Drawing draw_scene(std::span<const TradeoffRow> rows, const std::string& scene, const std::string& about) {
    std::vector<PlotPanel> panels;
    std::vector<std::string> done;
    for (const TradeoffRow& row : rows) {
        if (row.scene != scene || std::find(done.begin(), done.end(), row.recording) != done.end()) continue;
        done.push_back(row.recording);
        panels.push_back(panel_of(row.recording, "ms a frame", of_place(rows, scene, row.recording)));
        if (floor_factor * row.floor > panels.back().y.low)
            panels.back().levels.push_back({floor_factor * row.floor, "3 times the reference's own error"});
    }
    return draw_plot(panels, plots_across, fmt::format("{}: error against time; {}", scene, about));
}

Drawing draw_over_all(std::span<const TradeoffRow> rows, const std::string& about) {
    const PlotPanel panel =
        panel_of("all scenes and recordings", "time of a frame, balanced = 1", over_all(rows));
    return draw_plot(std::span(&panel, 1), 1, "Error against time; " + about, {760, 480});
}

}  // namespace tarn
