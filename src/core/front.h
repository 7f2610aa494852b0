// The measured front between speed and accuracy: assets/front.json, which `tarn tradeoff --write-front`
// makes. The setting `tradeoff` moves along it, and so does the governor.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/settings.h"

namespace tarn {

struct FrontPoint {
    Quality quality = Quality::Balanced;  // what `set` changes
    std::vector<std::string> set = {};    // key=value; empty: the quality itself
    double time = 1;                      // of a frame, as a ratio to `balanced`
    double error = 0;                     // relMSE
};

// From fast to accurate: time grows, error falls. At least one point; read once.
std::span<const FrontPoint> front();

// "balanced samples_per_pixel=2".
std::string front_label(const FrontPoint& point);

// Throws Error naming `origin` and what is wrong.
std::vector<FrontPoint> parse_front(const std::string& text, const std::string& origin);
std::string front_json(std::span<const FrontPoint> points, const std::string& made_by);

// Between 0 (the first point) and 1 (the last) on the slider, and back to the nearest point.
float front_position(std::size_t point);
std::size_t front_point(double position);

// The point that these settings are, by what the qualities set; nothing where they were changed since.
std::optional<std::size_t> point_of(const Settings& settings);

// The point's quality and what it changes, and `tradeoff`.
void apply_front_point(Settings& settings, std::size_t point);

}  // namespace tarn
