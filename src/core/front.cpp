#include "core/front.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/assets.h"
#include "core/error.h"

namespace tarn {

namespace {

using Json = nlohmann::ordered_json;

constexpr auto asset = "assets/front.json";

void apply_to(Settings& settings, const FrontPoint& point) {
    apply_preset(settings, point.quality);
    for (const std::string& assignment : point.set) set_assignment(settings, assignment);
}

}  // namespace

std::vector<FrontPoint> parse_front(const std::string& text, const std::string& origin) {
    std::vector<FrontPoint> points;
    try {
        const Json root = Json::parse(text);
        for (const Json& item : root.at("points")) {
            FrontPoint point{.set = item.at("set").get<std::vector<std::string>>(),
                             .time = item.at("time").get<double>(),
                             .error = item.at("error").get<double>()};
            const auto names = choice_names<Quality>();
            const auto named = std::find(names.begin(), names.end(), item.at("quality").get<std::string>());
            if (named == names.end()) fail("{}: point {}: no such quality", origin, points.size());
            point.quality = static_cast<Quality>(named - names.begin());
            const auto keys = preset_keys();
            for (const std::string& assignment : point.set)
                if (std::find(keys.begin(), keys.end(), assignment.substr(0, assignment.find('='))) ==
                    keys.end())
                    fail("{}: point {}: {}: no setting that qualities set", origin, points.size(),
                         assignment);
            Settings trial;
            apply_to(trial, point);
            const bool in_order =
                points.empty() || (point.time > points.back().time && point.error < points.back().error);
            if (!(point.time > 0) || !(point.error > 0) || !in_order)
                fail("{}: point {}: time must grow and error fall, both above 0", origin, points.size());
            points.push_back(std::move(point));
        }
    } catch (const nlohmann::json::exception& error) {
        fail("{}: not a front of `tarn tradeoff --write-front`: {}", origin, error.what());
    }
    if (points.empty()) fail("{}: no points", origin);
    return points;
}

std::string front_json(std::span<const FrontPoint> points, const std::string& made_by) {
    Json root;
    root["made_by"] = made_by;
    root["points"] = Json::array();
    for (const FrontPoint& point : points)
        root["points"].push_back(
            {{"quality", choice_names<Quality>()[static_cast<std::size_t>(point.quality)]},
             {"set", point.set},
             {"time", point.time},
             {"error", point.error}});
    return root.dump(1) + "\n";
}

std::span<const FrontPoint> front() {
    static const std::vector<FrontPoint> points = parse_front(read_asset(asset), asset);
    return points;
}

std::string front_label(const FrontPoint& point) {
    return fmt::format("{}{}{}", choice_names<Quality>()[static_cast<std::size_t>(point.quality)],
                       point.set.empty() ? "" : " ", fmt::join(point.set, " "));
}

float front_position(std::size_t point) {
    const std::size_t last = front().size() - 1;
    return last == 0 ? 0 : static_cast<float>(std::min(point, last)) / static_cast<float>(last);
}

std::size_t front_point(double position) {
    const auto last = static_cast<double>(front().size() - 1);
    return static_cast<std::size_t>(std::lround(std::clamp(position, 0.0, 1.0) * last));
}

std::optional<std::size_t> point_of(const Settings& settings) {
    const auto points = front();
    for (std::size_t i = 0; i < points.size(); ++i) {
        Settings of_point = settings;
        apply_to(of_point, points[i]);
        const auto keys = preset_keys();
        const bool same = std::all_of(keys.begin(), keys.end(), [&](const std::string& key) {
            const SettingInfo& info = *find_setting(key);
            return info.get(of_point) == info.get(settings);
        });
        if (same) return i;
    }
    return std::nullopt;
}

void apply_front_point(Settings& settings, std::size_t point) {
    const auto points = front();
    CHECK(point < points.size());
    apply_to(settings, points[point]);
    settings.tradeoff = front_position(point);
}

}  // namespace tarn
