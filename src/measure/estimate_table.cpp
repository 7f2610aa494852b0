#include "measure/estimate_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tarn {

namespace {

constexpr Quality shown[] = {Quality::Baseline, Quality::Fast, Quality::Balanced, Quality::Quality};

bool is_sure(const EstimateRow& row) {
    return row.predicted > 0 && row.error >= floor_factor * row.floor;
}

}  // namespace

std::vector<EstimateRow> estimate_rows(std::span<const TradeoffRow> rows) {
    std::vector<EstimateRow> estimates;
    for (const Quality quality : shown) {
        const Configuration configuration = configuration_of(quality);
        for (const TradeoffRow& row : rows)
            if (row.configuration == configuration && row.predicted > 0)
                estimates.push_back({.scene = row.scene,
                                     .label = label_of(configuration) + " " + row.recording,
                                     .predicted = row.predicted,
                                     .error = row.error,
                                     .floor = row.floor});
    }
    return estimates;
}

std::string estimate_csv(std::span<const EstimateRow> rows) {
    std::string text = "scene,picture,exact_samples,predicted,error,floor\n";
    for (const EstimateRow& r : rows)
        text +=
            fmt::format("{},{},{},{},{},{}\n", r.scene, r.label, r.samples, r.predicted, r.error, r.floor);
    return text;
}

std::string estimate_text(std::span<const EstimateRow> rows) {
    std::string text =
        "The estimated error against the true one. It is that of some thousand pixels against two fresh "
        "samples of\n"
        "exact each, up to eight such trials together; where they are unsure, and in exact from 64 samples "
        "on, the\n"
        "spread of the picture's own frames:\n";
    const auto line = [&](const std::string& name, const std::function<bool(const EstimateRow&)>& counts) {
        double sum = 0;
        double least = 1e300;
        double most = 0;
        int n = 0;
        for (const EstimateRow& r : rows) {
            if (!counts(r) || !is_sure(r)) continue;
            const double factor = r.error / r.predicted;
            sum += std::log(factor);
            least = std::min(least, factor);
            most = std::max(most, factor);
            ++n;
        }
        if (n > 0)
            text += fmt::format(
                "  {:<16} true is {:.2f} times the estimate, from {:.2f} to {:.2f} ({} pictures)\n", name,
                std::exp(sum / n), least, most, n);
        else
            text += fmt::format("  {:<16} no picture whose reference is sure enough\n", name);
    };
    std::vector<std::string> scenes;
    for (const EstimateRow& r : rows)
        if (r.samples > 0 && std::find(scenes.begin(), scenes.end(), r.scene) == scenes.end())
            scenes.push_back(r.scene);
    line("exact", [](const EstimateRow& r) { return r.samples > 0; });
    // Where light comes along rare paths, few samples do not know what they have not met.
    for (const std::string& scene : scenes)
        line(fmt::format("exact, {}", scene),
             [&](const EstimateRow& r) { return r.samples > 0 && r.scene == scene; });
    for (const Quality quality : shown) {
        const std::string name = choice_names<Quality>()[static_cast<std::size_t>(quality)];
        line(name, [&](const EstimateRow& r) { return r.samples == 0 && r.label.starts_with(name + " "); });
    }
    return text;
}

Drawing draw_estimates(std::span<const EstimateRow> rows) {
    PlotPanel panel{.title = "a picture's error as the overlay estimates it, and as it is",
                    .x = {.label = "estimated relMSE, by fresh exact samples in some pixels",
                          .log = true,
                          .low = 1e30,
                          .high = 0},
                    .y = {.label = "true relMSE", .log = true, .low = 1e30, .high = 0}};
    PlotSeries exact{.name = "exact", .line = false, .dots = true, .dot_radius = 3};
    PlotSeries others{
        .name = "other qualities", .line = false, .dots = true, .dot_radius = 3, .filled = false};
    double low = 1e30;
    double high = 0;
    for (const EstimateRow& r : rows) {
        if (!is_sure(r)) continue;
        (r.samples > 0 ? exact : others).points.push_back({r.predicted, r.error});
        low = std::min({low, r.predicted, r.error});
        high = std::max({high, r.predicted, r.error});
    }
    if (high <= low) low = 0.1, high = 1;
    panel.x.low = panel.y.low = low / 1.3;
    panel.x.high = panel.y.high = high;
    const PlotSeries equal{.name = "equal", .points = {{low / 1.3, low / 1.3}, {1.3 * high, 1.3 * high}}};
    panel.series = {exact, others, equal};
    return draw_plot(std::span(&panel, 1), 1, "tarn tradeoff: scenes, recordings and numbers of samples",
                     {560, 480});
}

}  // namespace tarn
