#include "measure/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tarn {

namespace {

// In px of the picture.
constexpr double margin_left = 64, margin_right = 16, margin_top = 30, margin_bottom = 46;
constexpr double head_height = 54;

// Okabe and Ito's colours, told apart by colour-blind readers; without yellow, which is faint on white.
constexpr const char* colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                  "#56b4e9", "#e69f00", "#000000"};

// Maps data to px along one axis.
struct Scale {
    double low, high, from_px, to_px;
    bool log;

    double px(double value) const {
        double part = 0;
        if (log)
            part = std::log(std::max(value, low) / low) / std::log(high / low);
        else
            part = (value - low) / (high - low);
        return from_px + part * (to_px - from_px);
    }
};

Scale scale_of(const PlotAxis& axis, std::span<const PlotSeries> series, int component, double from_px,
               double to_px) {
    CHECK(axis.low < axis.high && (!axis.log || axis.low > 0));
    double low = axis.low;
    double high = axis.high;
    for (const PlotSeries& line : series)
        for (const glm::dvec2& point : line.points) {
            if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
            if (!axis.log) low = std::min(low, point[component]);
            high = std::max(high, point[component]);
        }
    // Lines keep off the frame of a logarithmic panel.
    constexpr double room = 1.3;
    return {low, axis.log ? room * high : high, from_px, to_px, axis.log};
}

// At most the first, lowest, highest and last point of each column of pixels: a plot of thousands of ticks
// stays small and looks the same.
std::vector<glm::dvec2> thinned(const std::vector<glm::dvec2>& px) {
    std::vector<glm::dvec2> result;
    for (auto first = px.begin(); first != px.end();) {
        const double column = std::floor(first->x);
        const auto end = std::find_if(first, px.end(), [&](auto p) { return std::floor(p.x) != column; });
        const auto lower = [](glm::dvec2 a, glm::dvec2 b) { return a.y < b.y; };
        const auto [lowest, highest] = std::minmax_element(first, end, lower);
        std::vector<std::vector<glm::dvec2>::const_iterator> kept = {first, lowest, highest, end - 1};
        std::sort(kept.begin(), kept.end());
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        for (const auto& at : kept) result.push_back(*at);
        first = end;
    }
    return result;
}

constexpr const char* grid_color = "#e4e4e4";

void draw_axes(const PlotPanel& panel, const Scale& x, const Scale& y, Drawing& drawing) {
    for (const double tick : axis_ticks(x.low, x.high, x.log)) {
        drawing.line({x.px(tick), y.from_px}, {x.px(tick), y.to_px}, grid_color);
        drawing.text({x.px(tick), y.from_px + 16}, fmt::format("{:g}", tick), Anchor::Middle);
    }
    for (const double tick : axis_ticks(y.low, y.high, y.log)) {
        drawing.line({x.from_px, y.px(tick)}, {x.to_px, y.px(tick)}, grid_color);
        drawing.text({x.from_px - 6, y.px(tick) + 4}, fmt::format("{:g}", tick), Anchor::End);
    }
    drawing.frame({x.from_px, y.to_px}, {x.to_px, y.from_px}, "#444444");
    const double middle = (x.from_px + x.to_px) / 2;
    drawing.text({middle, y.to_px - 10}, panel.title, Anchor::Middle, "#000000", true);
    drawing.text({middle, y.from_px + 36}, panel.x.label, Anchor::Middle);
    drawing.text({x.from_px - 46, (y.from_px + y.to_px) / 2}, panel.y.label, Anchor::Middle, "#000000", false,
                 true);
}

void draw_series(const PlotSeries& series, const Scale& x, const Scale& y, const char* color,
                 Drawing& drawing) {
    std::vector<glm::dvec2> px;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
        const glm::dvec2& point = series.points[i];
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
        px.push_back({x.px(point.x), y.px(point.y)});
        if (series.dots) drawing.circle(px.back(), series.dot_radius, color, series.filled);
        if (i < series.labels.size() && !series.labels[i].empty()) {
            // Inside the frame, whichever side the point is on.
            const bool right = px.back().x > (x.from_px + 2 * x.to_px) / 3;
            drawing.text(px.back() + glm::dvec2(right ? -7 : 7, series.labels_below ? 16 : -6),
                         series.labels[i], right ? Anchor::End : Anchor::Start, color);
        }
    }
    if (series.line && !px.empty()) drawing.polyline(thinned(px), color, 1.5);
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, bool log) {
    std::vector<double> ticks;
    // Sums of rounded steps may miss the end of the axis by this part of it.
    constexpr double slack = 1e-9;
    if (log) {
        for (double e = std::ceil(std::log10(low) - slack); e <= std::log10(high) + slack; ++e)
            ticks.push_back(std::pow(10.0, e));
        if (high < 100 * low) {
            for (double e = std::floor(std::log10(low)); e <= std::log10(high); ++e)
                for (const double factor : {2.0, 5.0})
                    if (const double tick = factor * std::pow(10.0, e); tick >= low && tick <= high)
                        ticks.push_back(tick);
            std::sort(ticks.begin(), ticks.end());
        }
        return ticks;
    }
    constexpr double labels_wanted = 6;
    const double rough = (high - low) / labels_wanted;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * decade;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * decade >= rough) step = factor * decade;
    for (double k = std::ceil(low / step - slack); k * step <= high + slack * (high - low); ++k)
        ticks.push_back(k * step + 0.0);  // no -0
    return ticks;
}

Drawing draw_plot(std::span<const PlotPanel> panels, int columns, const std::string& caption,
                  glm::dvec2 panel_px) {
    CHECK(columns > 0);
    std::vector<std::string> names;
    for (const PlotPanel& panel : panels)
        for (const PlotSeries& series : panel.series)
            if (std::find(names.begin(), names.end(), series.name) == names.end())
                names.push_back(series.name);
    const auto color_of = [&](const std::string& name) {
        return colors[(std::find(names.begin(), names.end(), name) - names.begin()) % std::size(colors)];
    };

    const auto count = static_cast<int>(panels.size());
    const int across = std::max(1, std::min(columns, count));
    const int down = (count + across - 1) / across;
    Drawing drawing({across * panel_px.x, head_height + down * panel_px.y});
    drawing.text({margin_left, 20}, caption);
    double legend_x = margin_left;
    for (const std::string& name : names) {
        drawing.line({legend_x, 38}, {legend_x + 24, 38}, color_of(name), 3);
        drawing.text({legend_x + 30, 42}, name);
        // A generous width of a letter, so that names do not meet.
        legend_x += 54 + 7.5 * static_cast<double>(name.size());
    }
    for (int i = 0; i < count; ++i) {
        const PlotPanel& panel = panels[i];
        const int column = i % across;
        const int row = i / across;
        const double left = column * panel_px.x;
        const double top = head_height + row * panel_px.y;
        const Scale x =
            scale_of(panel.x, panel.series, 0, left + margin_left, left + panel_px.x - margin_right);
        const Scale y =
            scale_of(panel.y, panel.series, 1, top + panel_px.y - margin_bottom, top + margin_top);
        draw_axes(panel, x, y, drawing);
        for (const PlotLevel& level : panel.levels) {
            drawing.line({x.from_px, y.px(level.y)}, {x.to_px, y.px(level.y)}, "#888888", 1, true);
            drawing.text({x.to_px - 4, y.px(level.y) - 4}, level.label, Anchor::End, "#666666");
        }
        for (const PlotSeries& series : panel.series)
            draw_series(series, x, y, color_of(series.name), drawing);
    }
    return drawing;
}

std::string svg_plot(std::span<const PlotPanel> panels, int columns, const std::string& caption) {
    return draw_plot(panels, columns, caption).svg();
}

}  // namespace tarn
