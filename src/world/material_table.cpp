#include "world/material_table.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tarn {

namespace {

struct NamedMaterial {
    std::string_view name;
    std::uint8_t id;
    Material material;
};

constexpr auto named = std::to_array<NamedMaterial>({
#define TARN_ROW(CONSTANT, name, id, r, g, b, rough, metal, ior, ar, ag, ab, er, eg, eb) \
    {#name, id, {{r, g, b}, float(rough), {ar, ag, ab}, float(ior), {er, eg, eb}, float(metal)}},
    TARN_MATERIALS(TARN_ROW)
#undef TARN_ROW
});

constexpr auto named_ids = [] {
    std::array<std::uint8_t, named.size()> ids{};
    for (std::size_t i = 0; i < named.size(); ++i) ids[i] = named[i].id;
    return ids;
}();

// The table's water as the settings can say it.
struct WaterView {
    glm::vec3 color{1};
    float ior = 1;
};

float clamp_to_setting(double value, std::string_view setting) {
    const SettingInfo* info = find_setting(setting);
    CHECK(info != nullptr);
    return static_cast<float>(glm::clamp(value, info->min, info->max));
}

WaterView view_of(const Material& water) {
    WaterView view;
    for (int c = 0; c < 3; ++c)
        view.color[c] = clamp_to_setting(std::exp(-double{water.absorption_per_m[c]}), "water_color");
    view.ior = clamp_to_setting(double{water.ior}, "water_ior");
    return view;
}

}  // namespace

bool shines(const Material& material) {
    return std::max({material.emission.x, material.emission.y, material.emission.z}) > 0;
}

MaterialTable default_materials() {
    MaterialTable table{};
    for (const NamedMaterial& row : named) table[row.id] = row.material;
    return table;
}

std::string_view material_name(std::uint8_t id) {
    for (const NamedMaterial& row : named) {
        if (row.id == id) return row.name;
    }
    return "";
}

std::optional<std::uint8_t> material_id(std::string_view name) {
    for (const NamedMaterial& row : named) {
        if (row.name == name) return row.id;
    }
    return std::nullopt;
}

std::span<const std::uint8_t> named_materials() {
    return named_ids;
}

void water_settings_from(const MaterialTable& table, Settings& settings) {
    const WaterView view = view_of(table[MATERIAL_WATER]);
    settings.water_color = view.color;
    settings.water_ior = view.ior;
}

void apply_water_settings(const Settings& settings, MaterialTable& table) {
    Material& water = table[MATERIAL_WATER];
    const WaterView view = view_of(water);
    // A channel that the settings leave alone keeps its absorption to the last bit, also beyond their range.
    for (int c = 0; c < 3; ++c) {
        if (settings.water_color[c] != view.color[c])
            water.absorption_per_m[c] =
                std::max(0.0f, static_cast<float>(-std::log(double{settings.water_color[c]})));
    }
    if (settings.water_ior != view.ior) water.ior = settings.water_ior;
}

}  // namespace tarn
