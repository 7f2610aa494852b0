#include "measure/tradeoff_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"

namespace tarn {

namespace {

std::size_t index_of(std::string_view key) {
    const auto keys = preset_keys();
    const auto found = std::find(keys.begin(), keys.end(), key);
    CHECK_MSG(found != keys.end(), "{} is set by no quality", key);
    return static_cast<std::size_t>(found - keys.begin());
}

const std::string& value_of(const Configuration& configuration, std::string_view key) {
    return configuration.values[index_of(key)];
}

double number_of(const std::string& text) {
    return std::stod(text);
}

// Whether the setting does something beside the others.
bool is_idle(const Configuration& c, std::string_view key) {
    if (key == "history_cap") return value_of(c, "history") != "count";
    if (key == "history_alpha") return value_of(c, "history") != "blend";
    if (key == "filter_passes") return value_of(c, "filter") == "none";
    if (key == "antialiasing") return value_of(c, "jitter") == "true";
    if (key == "guided_upsampling")
        return value_of(c, "resolution_scale") == "1" || value_of(c, "history") == "none";
    if (key == "retrace_changes") return value_of(c, "history") != "count";
    if (key == "sun_through_water") return value_of(c, "light_sampling") == "none";
    return false;
}

// With idle settings as `balanced` has them.
Configuration canonical(Configuration c) {
    static const Configuration plain = configuration_of(Quality::Balanced);
    const auto keys = preset_keys();
    const Configuration as_given = c;
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (is_idle(as_given, keys[i])) c.values[i] = plain.values[i];
    return c;
}

bool same(const Configuration& a, const Configuration& b) {
    return canonical(a) == canonical(b);
}

std::vector<std::string> steps_along(const Coordinate& coordinate, const std::string& now) {
    std::vector<std::string> steps;
    if (!coordinate.ordered) {
        for (const char* value : coordinate.values)
            if (now != value) steps.emplace_back(value);
        return steps;
    }
    std::optional<std::string> below, above;
    for (const char* value : coordinate.values) {
        if (number_of(value) < number_of(now)) below = value;
        if (number_of(value) > number_of(now) && !above) above = value;
    }
    if (below) steps.push_back(*below);
    if (above) steps.push_back(*above);
    return steps;
}

}  // namespace

// By worth, about: a small budget ends in the middle. straight_sunlight is none of them: what it stands for
// are caustics, which references of hundreds of samples miss.
std::span<const Coordinate> tradeoff_coordinates() {
    static const Coordinate coordinates[] = {
        {"resolution_scale", {"0.25", "0.35", "0.4", "0.45", "0.55", "0.65", "0.75", "0.85", "1"}, true},
        {"samples_per_pixel", {"1", "2", "4", "8"}, true},
        {"new_pixel_samples", {"1", "2", "4"}, true},
        {"antialiasing", {"0", "4", "8"}, false},
        {"history_cap", {"4", "8", "16", "32", "48", "96", "256"}, true},
        {"filter", {"none", "gaussian", "edge_aware"}, false},
        {"filter_passes", {"1", "2", "3"}, true},
        {"max_diffuse_bounces", {"0", "1", "2", "3", "4", "6", "16"}, true},
        {"roulette_after", {"0", "1", "2", "4", "16"}, true},
        {"firefly_limit", {"1", "2", "3", "4", "8", "20", "1000"}, true},
        {"smooth_water", {"false", "true"}, false},
        {"light_sampling", {"none", "lights", "all"}, false},
        {"guided_upsampling", {"false", "true"}, false},
        {"retrace_changes", {"false", "true"}, false},
        {"history", {"none", "blend", "count"}, false},
        {"history_alpha", {"0.03", "0.1", "0.3"}, true},
        {"max_bounces", {"2", "4", "8", "16", "24", "64"}, true},
        {"max_distance_vox", {"64", "256", "4096"}, true},
        {"sun_through_water", {"false", "true"}, false},
        {"jitter", {"false", "true"}, false},
        {"caustics", {"false", "true"}, false},
        {"diffuse_sampling", {"cosine", "uniform"}, false},
        {"traversal", {"voxel", "distance"}, false}};
    return coordinates;
}

Configuration configuration_of(const Settings& settings) {
    Configuration configuration;
    for (const std::string& key : preset_keys())
        configuration.values.push_back(setting_text(settings, *find_setting(key)));
    return configuration;
}

Configuration configuration_of(Quality quality) {
    Settings settings;
    apply_quality(settings, quality);
    return configuration_of(settings);
}

void apply(const Configuration& configuration, Settings& settings) {
    const auto keys = preset_keys();
    CHECK(configuration.values.size() == keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) set_setting(settings, keys[i], configuration.values[i]);
}

std::string text_of(const Configuration& configuration) {
    const auto keys = preset_keys();
    std::string text;
    for (std::size_t i = 0; i < keys.size(); ++i)
        text += fmt::format("{}{}={}", i > 0 ? " " : "", keys[i], configuration.values[i]);
    return text;
}

Configuration parse_configuration(const std::string& text) {
    Settings settings;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        set_assignment(settings, text.substr(begin, end - begin));
        begin = end + 1;
    }
    return configuration_of(settings);
}

Nearest nearest_quality(const Configuration& configuration) {
    const auto keys = preset_keys();
    const Configuration wanted = canonical(configuration);
    std::optional<Nearest> best;
    for (const Quality quality : {Quality::Baseline, Quality::Fast, Quality::Balanced, Quality::Quality}) {
        const Configuration base = canonical(configuration_of(quality));
        Nearest nearest{.quality = quality, .differs = {}};
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (wanted.values[i] != base.values[i])
                nearest.differs.push_back(fmt::format("{}={}", keys[i], wanted.values[i]));
        if (!best || nearest.differs.size() < best->differs.size()) best = nearest;
    }
    return *best;
}

std::string label_of(const Configuration& configuration) {
    const Nearest nearest = nearest_quality(configuration);
    return fmt::format("{}{}{}", choice_names<Quality>()[static_cast<std::size_t>(nearest.quality)],
                       nearest.differs.empty() ? "" : " ", fmt::join(nearest.differs, " "));
}

namespace {

std::vector<Configuration> neighbours_along(const Coordinate& coordinate,
                                            const Configuration& configuration) {
    std::vector<Configuration> neighbours;
    if (is_idle(configuration, coordinate.key)) return neighbours;
    const std::size_t at = index_of(coordinate.key);
    for (const std::string& value : steps_along(coordinate, configuration.values[at])) {
        Configuration next = configuration;
        next.values[at] = value;
        if (!same(next, configuration)) neighbours.push_back(canonical(next));
    }
    return neighbours;
}

}  // namespace

std::vector<Configuration> neighbours_of(const Configuration& configuration) {
    std::vector<Configuration> neighbours;
    for (const Coordinate& coordinate : tradeoff_coordinates())
        for (Configuration& next : neighbours_along(coordinate, configuration))
            neighbours.push_back(std::move(next));
    return neighbours;
}

std::vector<std::size_t> pareto_front(std::span<const Measured> measured) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < measured.size(); ++i)
        if (measured[i].eligible) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(measured[a].time, measured[a].error) <
               std::pair(measured[b].time, measured[b].error);
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || measured[i].error < measured[front.back()].error) front.push_back(i);
    return front;
}

CoordinateSearch::CoordinateSearch(std::vector<Configuration> starts, int budget)
    : starts_(std::move(starts)), budget_(budget) {}

std::vector<Configuration> CoordinateSearch::fresh(std::vector<Configuration> wanted) const {
    std::vector<Configuration> result;
    for (Configuration& c : wanted) {
        const auto is_same = [&](const Configuration& other) { return same(c, other); };
        if (std::any_of(result.begin(), result.end(), is_same)) continue;
        if (std::any_of(measured_.begin(), measured_.end(),
                        [&](const Measured& m) { return is_same(m.configuration); }))
            continue;
        if (static_cast<int>(measured_.size() + result.size()) >= budget_) break;
        result.push_back(std::move(c));
    }
    return result;
}

std::vector<Configuration> CoordinateSearch::next() {
    if (!began_) {
        began_ = true;
        if (auto batch = fresh(starts_); !batch.empty()) return batch;
    }
    const auto coordinates = tradeoff_coordinates();
    while (static_cast<int>(measured_.size()) < budget_) {
        std::vector<Configuration> wanted;
        if (next_coordinate_ < coordinates.size()) {
            const Coordinate& coordinate = coordinates[next_coordinate_++];
            for (const Configuration& start : starts_)
                for (Configuration& next : neighbours_along(coordinate, start))
                    wanted.push_back(std::move(next));
        } else {
            const auto center = best_unexpanded();
            if (!center) return {};
            expanded_.push_back(canonical(*center));
            wanted = neighbours_of(*center);
        }
        if (auto batch = fresh(std::move(wanted)); !batch.empty()) return batch;
    }
    return {};
}

// The point of the front with the least time times error of those whose neighbours were not measured yet.
std::optional<Configuration> CoordinateSearch::best_unexpanded() const {
    std::optional<Configuration> best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : pareto_front(measured_)) {
        const Measured& m = measured_[i];
        const auto is_same = [&](const Configuration& other) { return same(m.configuration, other); };
        if (std::any_of(expanded_.begin(), expanded_.end(), is_same) ||
            std::any_of(starts_.begin(), starts_.end(), is_same) || m.time * m.error >= least)
            continue;
        least = m.time * m.error;
        best = m.configuration;
    }
    return best;
}

void CoordinateSearch::report(std::span<const Measured> measured) {
    measured_.insert(measured_.end(), measured.begin(), measured.end());
}

}  // namespace tarn
