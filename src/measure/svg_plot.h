// Plots of lines and dots, several panels in one drawing. Knows nothing of what it draws.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "measure/drawing.h"

namespace tarn {

// Series of one name have one colour in all panels.
struct PlotSeries {
    std::string name;
    std::vector<glm::dvec2> points =
        {};  // in order of x where `line`; those that are not finite are left out
    bool line = true;
    bool dots = false;
    std::vector<std::string> labels = {};  // beside the points, in their order; may be fewer
    bool labels_below = false;             // the points; else above
    double dot_radius = 2.5;
    bool filled = true;  // of the dots
};

struct PlotLevel {  // a horizontal line across the panel
    double y = 0;
    std::string label;
};

struct PlotAxis {
    std::string label;
    bool log = false;
    // The axis ends here at least; on a logarithmic one, what lies below `low` is drawn at its low end.
    double low = 0, high = 1;
};

struct PlotPanel {
    std::string title;
    PlotAxis x, y;
    std::vector<PlotSeries> series = {};
    std::vector<PlotLevel> levels = {};
};

// `panel_px`: the size of a panel with its labels.
Drawing draw_plot(std::span<const PlotPanel> panels, int columns, const std::string& caption,
                  glm::dvec2 panel_px = {420, 300});
std::string svg_plot(std::span<const PlotPanel> panels, int columns, const std::string& caption);

// Where labels stand on an axis from `low` to `high`: decades (less than two: also twice and five times one),
// or steps of 1, 2 or 5 times one.
std::vector<double> axis_ticks(double low, double high, bool log);

}  // namespace tarn
