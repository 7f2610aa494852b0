// The worlds in which water is measured: what is placed, poured and opened, and what is looked at. Owns no
// figure's target (water_table.h) and steps nothing.
#pragma once
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "world/scene.h"

namespace tarn {

// The figures that scenarios have in the table, by name.
struct Figure {
    std::string name;
    double value = 0;  // infinity: never
};

// How far the water is from level: signed (left above right) where two arms are compared.
struct LevelMeasure {
    const char* goal;  // the figure that says from which tick it stays `good`
    std::function<double(const Cells&)> value;
    double limit;             // good while the absolute value is at most this
    const char* axis;         // what a plot of it says
    bool false_head = false;  // the worst of right above left is a figure

    bool good(double measured) const { return std::abs(measured) <= limit; }
};

// Every cell of `region` that holds air is filled with water before each of the first ticks.
struct WaterTap {
    Box region;
    int ticks = 0;
};

struct WaterScenario {
    const char* name;
    const char* what;  // one line
    int ticks_max;
    std::function<Cells()> build;
    std::optional<WaterTap> tap = {};
    // Once at rest, or after ticks_max, this becomes air and the count of ticks starts over.
    std::optional<Box> opening = {};
    std::optional<LevelMeasure> level = {};
    std::function<std::vector<Figure>(const Cells&)> at_end;
};

std::span<const WaterScenario> water_scenarios();

// Null where there is none.
const WaterScenario* find_water_scenario(const std::string& name);

// As a scene without springs and drains.
Scene scene_of(const WaterScenario& scenario, std::uint32_t seed);

}  // namespace tarn
