// Optical properties by material id: the defaults of glsl/shared/materials.h, overridden by scenes and
// settings.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "core/settings.h"
#include "shared/materials.h"

namespace tarn {

struct Material {
    glm::vec3 base_color{0};        // [0,1], linear
    float roughness = 1;            // [0,1]; alpha = roughness^2
    glm::vec3 absorption_per_m{0};  // >= 0
    float ior = 1;                  // [0.75,3]
    glm::vec3 emission{0};          // radiance, >= 0
    float metallic = 0;             // [0,1]
    bool operator==(const Material&) const = default;
};

using MaterialTable = std::array<Material, MATERIAL_COUNT>;  // by id; water at MATERIAL_WATER

// Whether it sends out light of its own.
bool shines(const Material& material);

MaterialTable default_materials();

// The material's name ("stone"), or "" for an id without one.
std::string_view material_name(std::uint8_t id);
std::optional<std::uint8_t> material_id(std::string_view name);
// Named ids in the order of the list.
std::span<const std::uint8_t> named_materials();

// water_color and water_ior are a view of the table's water: colour = exp(-absorption) within the setting's
// range.
void water_settings_from(const MaterialTable& table, Settings& settings);
// Writes them back where they differ from that view.
void apply_water_settings(const Settings& settings, MaterialTable& table);

}  // namespace tarn
