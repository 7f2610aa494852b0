#include "core/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/front.h"
#include "core/sun_clock.h"

namespace tarn {

namespace {

constexpr const char* water_tier_names[] = {"block", "level", "pressure"};
constexpr const char* quality_names[] = {"baseline", "fast", "balanced", "quality", "exact"};
constexpr const char* traversal_names[] = {"voxel", "distance"};
constexpr const char* light_sampling_names[] = {"none", "lights", "all"};
constexpr const char* diffuse_sampling_names[] = {"cosine", "uniform"};
constexpr const char* history_names[] = {"none", "blend", "count", "exact"};
constexpr const char* filter_names[] = {"none", "gaussian", "edge_aware"};
constexpr const char* sky_model_names[] = {"gradient", "preetham"};
constexpr const char* tone_map_names[] = {"filmic", "linear"};
constexpr const char* view_kind_names[] = {"picture", "albedo", "normal",  "depth",   "material",
                                           "bounces", "steps",  "history", "variance"};

// What each quality sets: every one names the same keys, so that the last chosen counts alone. baseline is
// the method of the 2023 course work (BRIEF): every voxel stepped through, uniform diffuse directions, no
// light sampling, blend with a constant weight, Gaussian blur.
struct PresetRow {
    const char* name;
    std::array<const char*, 5> values;  // baseline, fast, balanced, quality, exact
};
constexpr PresetRow presets[] = {{"max_bounces", {"8", "16", "24", "64", "1024"}},
                                 {"max_diffuse_bounces", {"1024", "2", "3", "3", "1024"}},
                                 {"max_distance_vox", {"4096", "4096", "4096", "4096", "10000000"}},
                                 {"samples_per_pixel", {"1", "1", "1", "2", "1"}},
                                 {"new_pixel_samples", {"1", "2", "2", "2", "1"}},
                                 {"resolution_scale", {"1", "0.4", "0.55", "1", "1"}},
                                 {"guided_upsampling", {"false", "false", "true", "true", "true"}},
                                 {"traversal", {"voxel", "distance", "distance", "distance", "distance"}},
                                 {"light_sampling", {"none", "lights", "lights", "lights", "lights"}},
                                 {"diffuse_sampling", {"uniform", "cosine", "cosine", "cosine", "cosine"}},
                                 {"low_discrepancy", {"false", "true", "true", "true", "false"}},
                                 {"sun_through_water", {"false", "true", "true", "true", "true"}},
                                 {"straight_sunlight", {"false", "true", "true", "true", "false"}},
                                 {"caustics", {"true", "false", "false", "false", "true"}},
                                 {"smooth_water", {"false", "true", "true", "true", "false"}},
                                 {"roulette_after", {"1024", "1", "1", "4", "4"}},
                                 {"jitter", {"false", "false", "false", "false", "true"}},
                                 {"firefly_limit", {"0", "4", "2", "3", "0"}},
                                 {"history", {"blend", "count", "count", "count", "exact"}},
                                 {"history_alpha", {"0.1", "0.1", "0.1", "0.1", "0.1"}},
                                 {"history_cap", {"48", "32", "48", "256", "48"}},
                                 {"retrace_changes", {"false", "true", "true", "true", "false"}},
                                 {"refine_at_rest", {"false", "true", "true", "true", "false"}},
                                 {"filter", {"gaussian", "edge_aware", "edge_aware", "edge_aware", "none"}},
                                 {"filter_passes", {"1", "1", "1", "1", "1"}},
                                 {"antialiasing", {"0", "0", "4", "8", "0"}}};

double parse_number(const SettingInfo& info, std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = info.kind != SettingKind::Int || value == std::floor(value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value) || !whole)
        fail("setting {}={}: not {}; allowed: {}", info.name, text,
             info.kind == SettingKind::Int ? "a whole number" : "a finite number", allowed_values(info));
    if (value < info.min || value > info.max)
        fail("setting {}={}: out of range; allowed: {}", info.name, text, allowed_values(info));
    return value;
}

glm::dvec3 parse_value(const SettingInfo& info, std::string_view text) {
    if (info.kind == SettingKind::Choice) {
        const auto found = std::find(info.choices.begin(), info.choices.end(), text);
        if (found == info.choices.end())
            fail("setting {}={}: no such choice; allowed: {}", info.name, text, allowed_values(info));
        return glm::dvec3(static_cast<double>(found - info.choices.begin()));
    }
    if (info.kind == SettingKind::Bool) {
        if (text == "true" || text == "1" || text == "on") return glm::dvec3(1);
        if (text == "false" || text == "0" || text == "off") return glm::dvec3(0);
        fail("setting {}={}: not true or false; allowed: {}", info.name, text, allowed_values(info));
    }
    if (info.components() == 1) return glm::dvec3(parse_number(info, text));
    glm::dvec3 value(0);
    std::string_view rest = text;
    for (int c = 0; c < 3; ++c) {
        const auto comma = rest.find(',');
        if ((c < 2) == (comma == std::string_view::npos))
            fail("setting {}={}: three numbers a,b,c needed; allowed: {}", info.name, text,
                 allowed_values(info));
        value[c] = parse_number(info, rest.substr(0, comma));
        rest = c < 2 ? rest.substr(comma + 1) : std::string_view{};
    }
    return value;
}

nlohmann::ordered_json json_value(const Settings& settings, const SettingInfo& info) {
    const glm::dvec3 value = info.get(settings);
    switch (info.kind) {
        case SettingKind::Int:
            return static_cast<std::int64_t>(value.x);
        case SettingKind::Real:
            return value.x;
        case SettingKind::Bool:
            return value.x != 0;
        case SettingKind::Choice:
            return info.choices[static_cast<std::size_t>(value.x)];
        case SettingKind::Vec3:
        case SettingKind::Color:
            return {value.x, value.y, value.z};
    }
    CHECK(false);
}

}  // namespace

template <>
std::span<const char* const> choice_names<WaterTier>() {
    return water_tier_names;
}
template <>
std::span<const char* const> choice_names<Quality>() {
    return quality_names;
}
template <>
std::span<const char* const> choice_names<Traversal>() {
    return traversal_names;
}
template <>
std::span<const char* const> choice_names<LightSampling>() {
    return light_sampling_names;
}
template <>
std::span<const char* const> choice_names<DiffuseSampling>() {
    return diffuse_sampling_names;
}
template <>
std::span<const char* const> choice_names<History>() {
    return history_names;
}
template <>
std::span<const char* const> choice_names<Filter>() {
    return filter_names;
}
template <>
std::span<const char* const> choice_names<SkyModel>() {
    return sky_model_names;
}
template <>
std::span<const char* const> choice_names<ToneMap>() {
    return tone_map_names;
}
template <>
std::span<const char* const> choice_names<ViewKind>() {
    return view_kind_names;
}

std::span<const SettingInfo> setting_infos() {
#define TARN_NUMBER(KIND, T, name, low, high, group_, effect_, help)                       \
    SettingInfo{#name,                                                                     \
                SettingKind::KIND,                                                         \
                SettingGroup::group_,                                                      \
                SettingEffect::effect_,                                                    \
                low,                                                                       \
                high,                                                                      \
                help,                                                                      \
                {},                                                                        \
                [](const Settings& s) { return glm::dvec3(static_cast<double>(s.name)); }, \
                [](Settings& s, glm::dvec3 v) { s.name = static_cast<T>(v.x); }},
#define TARN_INT(name, value, low, high, group_, effect_, help) \
    TARN_NUMBER(Int, int, name, low, high, group_, effect_, help)
#define TARN_REAL(name, value, low, high, group_, effect_, help) \
    TARN_NUMBER(Real, float, name, low, high, group_, effect_, help)
#define TARN_BOOL(name, value, group_, effect_, help) \
    TARN_NUMBER(Bool, bool, name, 0, 1, group_, effect_, help)
#define TARN_CHOICE(Enum, name, value, group_, effect_, help)                              \
    SettingInfo{#name,                                                                     \
                SettingKind::Choice,                                                       \
                SettingGroup::group_,                                                      \
                SettingEffect::effect_,                                                    \
                0,                                                                         \
                static_cast<double>(choice_names<Enum>().size()) - 1,                      \
                help,                                                                      \
                choice_names<Enum>(),                                                      \
                [](const Settings& s) { return glm::dvec3(static_cast<double>(s.name)); }, \
                [](Settings& s, glm::dvec3 v) { s.name = static_cast<Enum>(static_cast<int>(v.x)); }},
#define TARN_TRIPLE(KIND, name, low, high, group_, effect_, help)     \
    SettingInfo{#name,                                                \
                SettingKind::KIND,                                    \
                SettingGroup::group_,                                 \
                SettingEffect::effect_,                               \
                low,                                                  \
                high,                                                 \
                help,                                                 \
                {},                                                   \
                [](const Settings& s) { return glm::dvec3(s.name); }, \
                [](Settings& s, glm::dvec3 v) { s.name = glm::vec3(v); }},
#define TARN_VEC3(name, x, y, z, low, high, group_, effect_, help) \
    TARN_TRIPLE(Vec3, name, low, high, group_, effect_, help)
#define TARN_COLOR(name, x, y, z, low, high, group_, effect_, help) \
    TARN_TRIPLE(Color, name, low, high, group_, effect_, help)
    static const SettingInfo infos[] = {
        TARN_SETTINGS(TARN_INT, TARN_REAL, TARN_BOOL, TARN_CHOICE, TARN_VEC3, TARN_COLOR)};
    return infos;
}

const char* group_name(SettingGroup group) {
    switch (group) {
        case SettingGroup::TRADE:
            return "Speed or accuracy";
        case SettingGroup::SIMULATION:
            return "Simulation";
        case SettingGroup::LIGHT:
            return "Light";
        case SettingGroup::IMAGE_FILTER:
            return "History and filter";
        case SettingGroup::CAMERA:
            return "Camera";
        case SettingGroup::WATER:
            return "Water";
        case SettingGroup::SKY:
            return "Sun and sky";
        case SettingGroup::DISPLAY:
            return "Display";
    }
    CHECK(false);
}

const SettingInfo* find_setting(std::string_view name) {
    for (const SettingInfo& info : setting_infos()) {
        if (name == info.name) return &info;
    }
    return nullptr;
}

std::string allowed_values(const SettingInfo& info) {
    switch (info.kind) {
        case SettingKind::Bool:
            return "true or false";
        case SettingKind::Choice:
            return fmt::format("one of {}", fmt::join(info.choices, ", "));
        case SettingKind::Int:
            return fmt::format("a whole number from {:.0f} to {:.0f}", info.min, info.max);
        case SettingKind::Real:
            return fmt::format("{} to {}", info.min, info.max);
        case SettingKind::Vec3:
        case SettingKind::Color:
            return fmt::format("a,b,c each {} to {}", info.min, info.max);
    }
    CHECK(false);
}

std::string setting_text(const Settings& settings, const SettingInfo& info) {
    const glm::dvec3 value = info.get(settings);
    switch (info.kind) {
        case SettingKind::Bool:
            return value.x != 0 ? "true" : "false";
        case SettingKind::Choice:
            return info.choices[static_cast<std::size_t>(value.x)];
        case SettingKind::Int:
            return fmt::format("{:.0f}", value.x);
        case SettingKind::Real:
            return fmt::format("{}", static_cast<float>(value.x));
        case SettingKind::Vec3:
        case SettingKind::Color: {
            const glm::vec3 v(value);
            return fmt::format("{},{},{}", v.x, v.y, v.z);
        }
    }
    CHECK(false);
}

void assign_setting(Settings& settings, const SettingInfo& info, glm::dvec3 value) {
    const std::string_view name = info.name;
    if (name == "quality") {
        apply_quality(settings, static_cast<Quality>(static_cast<int>(value.x)));
        return;
    }
    if (name == "tradeoff") {
        apply_front_point(settings, front_point(value.x));
        settings.tradeoff = static_cast<float>(value.x);
        return;
    }
    info.set(settings, value);
    if (name == "time_of_day_h") {
        const SunPosition sun = sun_position(value.x);
        settings.sun_azimuth_deg = static_cast<float>(sun.azimuth_deg);
        settings.sun_elevation_deg = static_cast<float>(sun.elevation_deg);
    }
}

void set_setting(Settings& settings, std::string_view name, std::string_view text) {
    const SettingInfo* info = find_setting(name);
    if (info == nullptr) fail("setting {}: no such setting; `tarn settings` lists them", name);
    assign_setting(settings, *info, parse_value(*info, text));
}

void set_assignment(Settings& settings, std::string_view assignment) {
    const auto equals = assignment.find('=');
    if (equals == std::string_view::npos)
        fail("--set {}: key=value needed; `tarn settings` lists the keys", assignment);
    set_setting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
}

void apply_preset(Settings& settings, Quality quality) {
    for (const PresetRow& row : presets)
        set_setting(settings, row.name, row.values[static_cast<std::size_t>(quality)]);
    settings.quality = quality;
}

void apply_quality(Settings& settings, Quality quality) {
    apply_preset(settings, quality);
    // Off the front: about where it would be.
    constexpr float else_at[] = {0, 0, 0.5f, 1, 1};
    const auto point = point_of(settings);
    settings.tradeoff = point ? front_position(*point) : else_at[static_cast<std::size_t>(quality)];
}

std::vector<std::string> preset_keys() {
    std::vector<std::string> keys;
    for (const PresetRow& row : presets) keys.emplace_back(row.name);
    return keys;
}

SettingEffect difference(const Settings& a, const Settings& b) {
    auto strongest = SettingEffect::NONE;
    for (const SettingInfo& info : setting_infos()) {
        if (info.get(a) != info.get(b)) strongest = std::max(strongest, info.effect);
    }
    return strongest;
}

std::string settings_json(const Settings& settings) {
    nlohmann::ordered_json object;
    for (const SettingInfo& info : setting_infos()) object[info.name] = json_value(settings, info);
    return object.dump(2);
}

}  // namespace tarn
