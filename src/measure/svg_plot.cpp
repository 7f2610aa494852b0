#include "measure/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tarn {

namespace {

// In px of the picture.
constexpr double panel_width = 420, panel_height = 300;
constexpr double margin_left = 64, margin_right = 16, margin_top = 30, margin_bottom = 46;
constexpr double head_height = 54;

// Okabe and Ito's colours, told apart by colour-blind readers; without yellow, which is faint on white.
constexpr const char* colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                  "#56b4e9", "#e69f00", "#000000"};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

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

std::string text_at(double x, double y, const char* anchor, const std::string& text, const char* more = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       escaped(text));
}

std::string line_at(double x1, double y1, double x2, double y2, const char* color, const char* more = "") {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"{}/>\n",
                       x1, y1, x2, y2, color, more);
}

std::string axes_of(const PlotPanel& panel, const Scale& x, const Scale& y) {
    std::string svg;
    for (const double tick : axis_ticks(x.low, x.high, x.log)) {
        svg += line_at(x.px(tick), y.from_px, x.px(tick), y.to_px, "#e4e4e4");
        svg += text_at(x.px(tick), y.from_px + 16, "middle", fmt::format("{:g}", tick));
    }
    for (const double tick : axis_ticks(y.low, y.high, y.log)) {
        svg += line_at(x.from_px, y.px(tick), x.to_px, y.px(tick), "#e4e4e4");
        svg += text_at(x.from_px - 6, y.px(tick) + 4, "end", fmt::format("{:g}", tick));
    }
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"#444\"/>\n",
        x.from_px, y.to_px, x.to_px - x.from_px, y.from_px - y.to_px);
    svg += text_at((x.from_px + x.to_px) / 2, y.to_px - 10, "middle", panel.title, " font-weight=\"bold\"");
    svg += text_at((x.from_px + x.to_px) / 2, y.from_px + 36, "middle", panel.x.label);
    const double middle = (y.from_px + y.to_px) / 2;
    const double left = x.from_px - 46;
    const std::string turn = fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", left, middle);
    return svg + text_at(left, middle, "middle", panel.y.label, turn.c_str());
}

std::string series_of(const PlotSeries& series, const Scale& x, const Scale& y, const char* color) {
    std::vector<glm::dvec2> px;
    for (const glm::dvec2& point : series.points)
        if (std::isfinite(point.x) && std::isfinite(point.y)) px.push_back({x.px(point.x), y.px(point.y)});
    std::string svg;
    if (series.dots)
        for (const glm::dvec2& p : px)
            svg +=
                fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>\n", p.x, p.y, color);
    if (!series.line || px.empty()) return svg;
    svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" points=\"", color);
    for (const glm::dvec2& p : thinned(px)) svg += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
    return svg + "\"/>\n";
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, bool log) {
    std::vector<double> ticks;
    // Sums of rounded steps may miss the end of the axis by this part of it.
    constexpr double slack = 1e-9;
    if (log) {
        for (double e = std::ceil(std::log10(low) - slack); e <= std::log10(high) + slack; ++e)
            ticks.push_back(std::pow(10.0, e));
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

std::string svg_plot(std::span<const PlotPanel> panels, int columns, const std::string& caption) {
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
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} "
        "{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"#fff\"/>\n",
        across * panel_width, head_height + down * panel_height);
    svg += text_at(margin_left, 20, "start", caption);
    double legend_x = margin_left;
    for (const std::string& name : names) {
        svg += line_at(legend_x, 38, legend_x + 24, 38, color_of(name), " stroke-width=\"3\"");
        svg += text_at(legend_x + 30, 42, "start", name);
        // A generous width of a letter, so that names do not meet.
        legend_x += 54 + 7.5 * static_cast<double>(name.size());
    }
    for (int i = 0; i < count; ++i) {
        const PlotPanel& panel = panels[i];
        const int column = i % across;
        const int row = i / across;
        const double left = column * panel_width;
        const double top = head_height + row * panel_height;
        const Scale x =
            scale_of(panel.x, panel.series, 0, left + margin_left, left + panel_width - margin_right);
        const Scale y =
            scale_of(panel.y, panel.series, 1, top + panel_height - margin_bottom, top + margin_top);
        svg += axes_of(panel, x, y);
        for (const PlotLevel& level : panel.levels) {
            svg += line_at(x.from_px, y.px(level.y), x.to_px, y.px(level.y), "#888",
                           " stroke-dasharray=\"4 3\"");
            svg += text_at(x.to_px - 4, y.px(level.y) - 4, "end", level.label, " fill=\"#666\"");
        }
        for (const PlotSeries& series : panel.series) svg += series_of(series, x, y, color_of(series.name));
    }
    return svg + "</svg>\n";
}

}  // namespace tarn
