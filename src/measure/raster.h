// Lines, circles and text as pixels, with smooth edges. Letters are those of the panels (ImGui's own font).
#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "core/image.h"

namespace tarn {

// Coordinates in px of `size`, y down; `scale` pixels each. Starts white.
class Raster {
  public:
    Raster(glm::ivec2 size, int scale);
    ~Raster();
    Raster(const Raster&) = delete;
    Raster& operator=(const Raster&) = delete;

    void set_color(const std::string& color);  // "#rrggbb"
    void line(glm::dvec2 from, glm::dvec2 to, double width);
    void circle(glm::dvec2 center, double radius, bool filled);
    // `share` of its length lies before `at`, which is on its baseline. ASCII.
    void text(glm::dvec2 at, const std::string& words, double share, bool bold, bool upward);

    const ImageRgba8& image() const { return image_; }

  private:
    struct Font;
    void blend(int x, int y, double coverage);

    double scale_;
    ImageRgba8 image_;
    glm::dvec3 color_{0};
    std::unique_ptr<Font> font_;
};

}  // namespace tarn
