// Every parameter of a run: a plain struct, and the table that describes its fields. Owns no state.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/settings_list.h"

namespace tarn {

enum class WaterTier { Block, Level, Pressure };
enum class Quality { Baseline, Fast, Balanced, Quality, Exact };
enum class Traversal { Voxel, Distance };
enum class LightSampling { None, Lights, All };
enum class DiffuseSampling { Cosine, Uniform };
enum class History { None, Blend, Count, Exact };
enum class Filter { None, Gaussian, EdgeAware };
enum class SkyModel { Gradient, Preetham };
enum class ToneMap { Filmic, Linear };
enum class ViewKind { Picture, Albedo, Normal, Depth, Material, Bounces, Steps, History, Variance };

// Names of an enum's values in order, as the command line and JSON spell them.
template <typename Enum>
std::span<const char* const> choice_names();
template <>
std::span<const char* const> choice_names<WaterTier>();
template <>
std::span<const char* const> choice_names<Quality>();
template <>
std::span<const char* const> choice_names<Traversal>();
template <>
std::span<const char* const> choice_names<LightSampling>();
template <>
std::span<const char* const> choice_names<DiffuseSampling>();
template <>
std::span<const char* const> choice_names<History>();
template <>
std::span<const char* const> choice_names<Filter>();
template <>
std::span<const char* const> choice_names<SkyModel>();
template <>
std::span<const char* const> choice_names<ToneMap>();
template <>
std::span<const char* const> choice_names<ViewKind>();

enum class SettingGroup { TRADE, SIMULATION, LIGHT, IMAGE_FILTER, CAMERA, WATER, SKY, DISPLAY };
enum class SettingEffect { NONE, IMAGE, TARGETS };
enum class SettingKind { Int, Real, Bool, Choice, Vec3, Color };

struct Settings {
#define TARN_INT(name, value, low, high, group, effect, help) int name = value;
#define TARN_REAL(name, value, low, high, group, effect, help) float name = static_cast<float>(value);
#define TARN_BOOL(name, value, group, effect, help) bool name = value;
#define TARN_CHOICE(Enum, name, value, group, effect, help) Enum name = Enum::value;
#define TARN_VEC3(name, x, y, z, low, high, group, effect, help) glm::vec3 name{x, y, z};
    TARN_SETTINGS(TARN_INT, TARN_REAL, TARN_BOOL, TARN_CHOICE, TARN_VEC3, TARN_VEC3)
#undef TARN_INT
#undef TARN_REAL
#undef TARN_BOOL
#undef TARN_CHOICE
#undef TARN_VEC3
    bool operator==(const Settings&) const = default;
};

// One field. Numbers are read and written as 1 or 3 doubles whatever the kind (a choice is its index).
struct SettingInfo {
    const char* name;
    SettingKind kind;
    SettingGroup group;
    SettingEffect effect;
    double min, max;
    const char* help;
    std::span<const char* const> choices;  // of a Choice
    glm::dvec3 (*get)(const Settings&);
    void (*set)(Settings&, glm::dvec3);

    int components() const { return kind == SettingKind::Vec3 || kind == SettingKind::Color ? 3 : 1; }
};

std::span<const SettingInfo> setting_infos();
const char* group_name(SettingGroup group);

// Null when there is no such setting.
const SettingInfo* find_setting(std::string_view name);

// "0 to 1024", "one of baseline, fast" and the like.
std::string allowed_values(const SettingInfo& info);

// The value as `set_setting` reads it.
std::string setting_text(const Settings& settings, const SettingInfo& info);

// Sets the field as its control does: `quality` applies its preset, `time_of_day_h` places the sun.
void assign_setting(Settings& settings, const SettingInfo& info, glm::dvec3 value);

// Parses `text` ("3", "0.5", "true", "block", "1,2,3") and assigns it to the field `name`. Throws
// Error naming the key, the reason and what is allowed.
void set_setting(Settings& settings, std::string_view name, std::string_view text);

// "key=value" as given to --set.
void set_assignment(Settings& settings, std::string_view assignment);

// Sets `quality` and every setting that its preset names.
void apply_quality(Settings& settings, Quality quality);

// The same, but for `tradeoff`, which apply_quality moves to where the quality lies on the front
// (core/front.h).
void apply_preset(Settings& settings, Quality quality);

// The settings that every quality sets, in the order of the presets.
std::vector<std::string> preset_keys();

// The strongest effect among the fields in which `a` and `b` differ.
SettingEffect difference(const Settings& a, const Settings& b);

// A JSON object of every setting, as text.
std::string settings_json(const Settings& settings);

}  // namespace tarn
