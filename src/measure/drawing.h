// A drawing of lines, circles and text, as SVG text or as pixels. Knows nothing of what it shows.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/image.h"

namespace tarn {

enum class Anchor { Start, Middle, End };

// In px of the drawing, y down. Colours are "#rrggbb".
class Drawing {
  public:
    explicit Drawing(glm::dvec2 size) : size_(size) {}

    void line(glm::dvec2 from, glm::dvec2 to, const std::string& color, double width = 1,
              bool dashed = false);
    void polyline(std::vector<glm::dvec2> points, const std::string& color, double width);
    // `filled`: else a ring.
    void circle(glm::dvec2 center, double radius, const std::string& color, bool filled = true);
    void frame(glm::dvec2 low, glm::dvec2 high, const std::string& color);
    // `at`: where the anchor of the text's baseline stands; upward: turned by 90 degrees, read from below.
    void text(glm::dvec2 at, const std::string& words, Anchor anchor = Anchor::Start,
              const std::string& color = "#000000", bool bold = false, bool upward = false);

    std::string svg() const;
    // On white, `scale` pixels a px.
    ImageRgba8 image(int scale) const;

  private:
    enum class Kind { Line, Polyline, Circle, Frame, Text };
    struct Item {
        Kind kind;
        std::vector<glm::dvec2> points;
        std::string color;
        double size = 1;    // a line's width, a circle's radius
        bool mark = false;  // dashed, filled, bold
        std::string words = {};
        Anchor anchor = Anchor::Start;
        bool upward = false;
    };
    glm::dvec2 size_;
    std::vector<Item> items_;
};

}  // namespace tarn
