#include "measure/raster.h"

#include <imgui.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

#include "core/error.h"

namespace tarn {

namespace {

// Of a letter, in px: that of SVG's text beside it.
constexpr float font_px = 13;

}  // namespace

struct Raster::Font {
    ImFontAtlas atlas;
    ImFont* font = nullptr;
    unsigned char* alpha = nullptr;
    int width = 0, height = 0;

    explicit Font(int scale) {
        ImFontConfig config;
        config.SizePixels = font_px * static_cast<float>(scale);
        config.PixelSnapH = true;
        config.OversampleH = config.OversampleV = 1;  // a texel of the atlas is a pixel
        font = atlas.AddFontDefault(&config);
        atlas.GetTexDataAsAlpha8(&alpha, &width, &height);
    }
};

Raster::Raster(glm::ivec2 size, int scale)
    : scale_(scale), image_{size.x * scale, size.y * scale, {}}, font_(std::make_unique<Font>(scale)) {
    image_.pixels.assign(std::size_t{4} * image_.width * image_.height, 255);
}

Raster::~Raster() = default;

void Raster::set_color(const std::string& color) {
    unsigned value = 0;
    CHECK(color.size() == 7);
    const auto parsed = std::from_chars(color.data() + 1, color.data() + 7, value, 16);
    CHECK(parsed.ptr == color.data() + 7);
    color_ = glm::dvec3(value >> 16 & 255, value >> 8 & 255, value & 255);
}

void Raster::blend(int x, int y, double coverage) {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
    coverage = std::clamp(coverage, 0.0, 1.0);
    std::uint8_t* pixel = &image_.pixels[std::size_t{4} * (std::size_t{1} * image_.width * y + x)];
    for (int c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(std::lround(pixel[c] + coverage * (color_[c] - pixel[c])));
}

void Raster::line(glm::dvec2 from, glm::dvec2 to, double width) {
    const glm::dvec2 a = from * scale_;
    const glm::dvec2 b = to * scale_;
    const double half = width * scale_ / 2;
    const glm::ivec2 low(glm::floor(glm::min(a, b) - half - 1.0));
    const glm::ivec2 high(glm::ceil(glm::max(a, b) + half + 1.0));
    const glm::dvec2 along = b - a;
    const double squared = glm::dot(along, along);
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            const double part = squared > 0 ? std::clamp(glm::dot(at - a, along) / squared, 0.0, 1.0) : 0;
            blend(x, y, half + 0.5 - glm::distance(at, a + part * along));
        }
}

void Raster::circle(glm::dvec2 center, double radius, bool filled) {
    constexpr double ring_width_px = 1.5;
    const glm::dvec2 c = center * scale_;
    const double r = radius * scale_;
    const double half = ring_width_px * scale_ / 2;
    const glm::ivec2 low(glm::floor(c - r - half - 1.0));
    const glm::ivec2 high(glm::ceil(c + r + half + 1.0));
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            const double distance = glm::distance(glm::dvec2(x + 0.5, y + 0.5), c);
            blend(x, y, filled ? r + 0.5 - distance : half + 0.5 - std::abs(distance - r));
        }
}

void Raster::text(glm::dvec2 at, const std::string& words, double share, bool bold, bool upward) {
    const ImFont& font = *font_->font;
    double length = 0;
    for (const char c : words) length += font.FindGlyph(static_cast<ImWchar>(c))->AdvanceX;
    const glm::dvec2 start = glm::round(at * scale_);
    double pen = std::round(-share * length);
    // ImGui's glyphs hang from the top of their line.
    const double top = -static_cast<double>(font.Ascent);
    for (const char c : words) {
        const ImFontGlyph& glyph = *font.FindGlyph(static_cast<ImWchar>(c));
        const auto u0 = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(font_->width)));
        const auto v0 = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(font_->height)));
        const auto wide = static_cast<int>(std::lround(glyph.X1 - glyph.X0));
        const auto tall = static_cast<int>(std::lround(glyph.Y1 - glyph.Y0));
        for (int v = 0; v < tall; ++v)
            for (int u = 0; u < wide; ++u) {
                const double coverage = font_->alpha[(v0 + v) * font_->width + u0 + u] / 255.0;
                if (coverage == 0) continue;
                const glm::dvec2 along(pen + std::round(glyph.X0) + u, top + std::round(glyph.Y0) + v);
                for (int again = 0; again <= (bold ? 1 : 0); ++again) {
                    const glm::dvec2 moved(along.x + again, along.y);
                    const glm::dvec2 px = start + (upward ? glm::dvec2(moved.y, -moved.x) : moved);
                    blend(static_cast<int>(px.x), static_cast<int>(px.y), coverage);
                }
            }
        pen += glyph.AdvanceX;
    }
}

}  // namespace tarn
