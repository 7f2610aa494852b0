#include "measure/drawing.h"

#include <fmt/format.h>

#include <algorithm>

#include "measure/raster.h"

namespace tarn {

namespace {

constexpr const char* anchor_names[] = {"start", "middle", "end"};
constexpr double dash_px = 4, gap_px = 3;

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

}  // namespace

void Drawing::line(glm::dvec2 from, glm::dvec2 to, const std::string& color, double width, bool dashed) {
    items_.push_back(
        {.kind = Kind::Line, .points = {from, to}, .color = color, .size = width, .mark = dashed});
}

void Drawing::polyline(std::vector<glm::dvec2> points, const std::string& color, double width) {
    items_.push_back({.kind = Kind::Polyline, .points = std::move(points), .color = color, .size = width});
}

void Drawing::circle(glm::dvec2 center, double radius, const std::string& color, bool filled) {
    items_.push_back(
        {.kind = Kind::Circle, .points = {center}, .color = color, .size = radius, .mark = filled});
}

void Drawing::frame(glm::dvec2 low, glm::dvec2 high, const std::string& color) {
    items_.push_back({.kind = Kind::Frame, .points = {low, high}, .color = color});
}

void Drawing::text(glm::dvec2 at, const std::string& words, Anchor anchor, const std::string& color,
                   bool bold, bool upward) {
    items_.push_back({.kind = Kind::Text,
                      .points = {at},
                      .color = color,
                      .mark = bold,
                      .words = words,
                      .anchor = anchor,
                      .upward = upward});
}

std::string Drawing::svg() const {
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" "
        "height=\"100%\" "
        "fill=\"#fff\"/>\n",
        size_.x, size_.y);
    for (const Item& item : items_) {
        const glm::dvec2 a = item.points.front();
        const glm::dvec2 b = item.points.back();
        switch (item.kind) {
            case Kind::Line:
                svg += fmt::format(
                    "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
                    "stroke-width=\"{:g}\"{}/>\n",
                    a.x, a.y, b.x, b.y, item.color, item.size,
                    item.mark ? fmt::format(" stroke-dasharray=\"{} {}\"", dash_px, gap_px) : "");
                break;
            case Kind::Polyline:
                svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" points=\"",
                                   item.color, item.size);
                for (const glm::dvec2& p : item.points) svg += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
                svg += "\"/>\n";
                break;
            case Kind::Circle:
                svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" {}=\"{}\"{}/>\n", a.x, a.y,
                                   item.size, item.mark ? "fill" : "stroke", item.color,
                                   item.mark ? "" : " fill=\"none\" stroke-width=\"1.5\"");
                break;
            case Kind::Frame:
                svg += fmt::format(
                    "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
                    "stroke=\"{}\"/>\n",
                    a.x, a.y, b.x - a.x, b.y - a.y, item.color);
                break;
            case Kind::Text:
                svg += fmt::format(
                    "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}{}{}>{}</text>\n", a.x, a.y,
                    anchor_names[static_cast<std::size_t>(item.anchor)],
                    item.color == "#000000" ? "" : fmt::format(" fill=\"{}\"", item.color),
                    item.mark ? " font-weight=\"bold\"" : "",
                    item.upward ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", a.x, a.y) : "",
                    escaped(item.words));
                break;
        }
    }
    return svg + "</svg>\n";
}

ImageRgba8 Drawing::image(int scale) const {
    Raster raster(glm::ivec2(glm::ceil(size_)), scale);
    for (const Item& item : items_) {
        raster.set_color(item.color);
        const glm::dvec2 a = item.points.front();
        const glm::dvec2 b = item.points.back();
        switch (item.kind) {
            case Kind::Line: {
                if (!item.mark) {
                    raster.line(a, b, item.size);
                    break;
                }
                const double length = glm::distance(a, b);
                const glm::dvec2 along = (b - a) / length;
                for (double at = 0; at < length; at += dash_px + gap_px)
                    raster.line(a + at * along, a + std::min(at + dash_px, length) * along, item.size);
                break;
            }
            case Kind::Polyline:
                for (std::size_t i = 1; i < item.points.size(); ++i)
                    raster.line(item.points[i - 1], item.points[i], item.size);
                break;
            case Kind::Circle:
                raster.circle(a, item.size, item.mark);
                break;
            case Kind::Frame:
                raster.line(a, {b.x, a.y}, 1);
                raster.line({b.x, a.y}, b, 1);
                raster.line(b, {a.x, b.y}, 1);
                raster.line({a.x, b.y}, a, 1);
                break;
            case Kind::Text: {
                const double share = item.anchor == Anchor::Start ? 0 : item.anchor == Anchor::End ? 1 : 0.5;
                raster.text(a, item.words, share, item.mark, item.upward);
                break;
            }
        }
    }
    return raster.image();
}

}  // namespace tarn
