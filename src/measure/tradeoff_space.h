// The settings that trade speed for accuracy as a space to search: configurations, their neighbours along one
// coordinate, and a search along the Pareto front. Measures nothing.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/settings.h"

namespace tarn {

struct Coordinate {
    const char* key;  // a setting that the qualities set
    std::vector<const char*> values;
    bool ordered;  // neighbours are the values next to the present one; else all others
};
std::span<const Coordinate> tradeoff_coordinates();

// Every setting that a quality sets, in their order, as text: two configurations are alike when these are.
struct Configuration {
    std::vector<std::string> values;  // by preset_keys()
    bool operator==(const Configuration&) const = default;
};

Configuration configuration_of(Quality quality);
Configuration configuration_of(const Settings& settings);
void apply(const Configuration& configuration, Settings& settings);

// "key=value" of every setting, separated by spaces; and what it takes to read it back. Throws Error.
std::string text_of(const Configuration& configuration);
Configuration parse_configuration(const std::string& text);

// The quality that it differs least from, and the key=value of what differs.
struct Nearest {
    Quality quality = Quality::Balanced;
    std::vector<std::string> differs;
};
Nearest nearest_quality(const Configuration& configuration);
// The name of a quality, or that of the nearest and what differs from it: "balanced history_cap=96".
std::string label_of(const Configuration& configuration);

// All that differ in one coordinate by one step. What the others make idle is left as it is (a cap without a
// history); configurations that differ in nothing else count as the same.
std::vector<Configuration> neighbours_of(const Configuration& configuration);

struct Measured {
    Configuration configuration;
    double time = 0, error = 0;
    bool eligible = true;  // for the front
};

// Indices of those that no other eligible one beats in both, by ascending time.
std::vector<std::size_t> pareto_front(std::span<const Measured> measured);

// Coordinate search: measures `starts`, then along one coordinate after the other the neighbours of all
// starts, then again and again those of the point of the front that has the least time times error of those
// not yet searched; until the front has been searched or `budget` configurations are measured.
class CoordinateSearch {
  public:
    CoordinateSearch(std::vector<Configuration> starts, int budget);
    // The next batch to measure; empty: done.
    std::vector<Configuration> next();
    void report(std::span<const Measured> measured);
    const std::vector<Measured>& measured() const { return measured_; }
    int budget() const { return budget_; }

  private:
    std::vector<Configuration> fresh(std::vector<Configuration> wanted) const;

    std::optional<Configuration> best_unexpanded() const;

    std::vector<Configuration> starts_, expanded_;
    std::size_t next_coordinate_ = 0;
    bool began_ = false;
    int budget_;
    std::vector<Measured> measured_;
};

}  // namespace tarn
