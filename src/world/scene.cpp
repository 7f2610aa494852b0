#include "world/scene.h"

#include <algorithm>
#include <new>

#include "core/assets.h"
#include "core/error.h"
#include "core/files.h"
#include "world/json_node.h"
#include "world/scene_build.h"

namespace tarn {

namespace {

namespace fs = std::filesystem;

constexpr auto scene_folder = "assets/scenes/";
constexpr double absorption_max_per_m = 1e4;
constexpr double emission_max = 1e6;
constexpr std::uint32_t seed_max = 0xffffffffu;

// Sets the setting `setting` from the key of an object, within the setting's own range.
void read_setting(const JsonNode& object, std::string_view key, std::string_view setting,
                  Settings& settings) {
    const auto node = object.find(key);
    if (!node) return;
    const SettingInfo* info = find_setting(setting);
    CHECK(info != nullptr);
    if (info->kind == SettingKind::Choice) {
        const auto found = std::find(info->choices.begin(), info->choices.end(), node->text());
        if (found == info->choices.end()) node->refuse("no such choice", allowed_values(*info));
        info->set(settings, glm::dvec3(static_cast<double>(found - info->choices.begin())));
        return;
    }
    assign_setting(settings, *info,
                   info->components() == 3 ? node->vec3(info->min, info->max)
                                           : glm::dvec3(node->number(info->min, info->max)));
}

void read_light_and_camera(const JsonNode& root, Settings& settings) {
    if (const auto camera = root.find("camera")) {
        camera->allow_only({"position_vox", "yaw_deg", "pitch_deg", "fov_deg"});
        read_setting(*camera, "position_vox", "camera_position_vox", settings);
        read_setting(*camera, "yaw_deg", "camera_yaw_deg", settings);
        read_setting(*camera, "pitch_deg", "camera_pitch_deg", settings);
        read_setting(*camera, "fov_deg", "camera_fov_deg", settings);
    }
    if (const auto sun = root.find("sun")) {
        sun->allow_only(
            {"time_of_day_h", "azimuth_deg", "elevation_deg", "irradiance", "angular_radius_deg"});
        read_setting(*sun, "time_of_day_h", "time_of_day_h", settings);
        read_setting(*sun, "azimuth_deg", "sun_azimuth_deg", settings);
        read_setting(*sun, "elevation_deg", "sun_elevation_deg", settings);
        read_setting(*sun, "irradiance", "sun_irradiance", settings);
        read_setting(*sun, "angular_radius_deg", "sun_angular_radius_deg", settings);
    }
    if (const auto sky = root.find("sky")) {
        sky->allow_only({"zenith", "horizon", "model", "turbidity", "brightness"});
        read_setting(*sky, "zenith", "sky_zenith", settings);
        read_setting(*sky, "horizon", "sky_horizon", settings);
        read_setting(*sky, "model", "sky_model", settings);
        read_setting(*sky, "turbidity", "turbidity", settings);
        read_setting(*sky, "brightness", "sky_brightness", settings);
    }
}

void read_materials(const JsonNode& list, MaterialTable& table) {
    for (const auto& [name, node] : list.members()) {
        const auto id = material_id(name);
        if (!id || *id == MATERIAL_AIR) {
            std::string names;
            for (const std::uint8_t known : named_materials().subspan(1))
                names += fmt::format("{}{}", names.empty() ? "" : ", ", material_name(known));
            node.refuse(id ? "air has no surface" : "unknown material", names);
        }
        node.allow_only({"base_color", "roughness", "metallic", "ior", "absorption_per_m", "emission"});
        Material& material = table[*id];
        const auto scalar = [&node = node](std::string_view key, double min, double max, float& value) {
            if (const auto child = node.find(key)) value = static_cast<float>(child->number(min, max));
        };
        const auto color = [&node = node](std::string_view key, double max, glm::vec3& value) {
            if (const auto child = node.find(key)) value = glm::vec3(child->vec3(0, max));
        };
        color("base_color", 1, material.base_color);
        scalar("roughness", 0, 1, material.roughness);
        scalar("metallic", 0, 1, material.metallic);
        scalar("ior", 0.75, 3, material.ior);
        color("absorption_per_m", absorption_max_per_m, material.absorption_per_m);
        color("emission", emission_max, material.emission);
    }
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& origin, const Settings& base,
                  std::optional<std::uint32_t> seed) {
    const JsonNode root = JsonNode::parse(text, origin);
    root.allow_only(
        {"description", "size", "metres_per_voxel", "seed", "camera", "sun", "sky", "materials", "build"});
    Scene scene;
    scene.name = asset_name(origin);
    scene.settings = base;
    const glm::ivec3 size = root.need("size").ivec3(1, world_side_max_vox);
    if (const auto node = root.find("description")) scene.description = printable(node->text());
    if (const auto node = root.find("metres_per_voxel"))
        scene.metres_per_voxel = static_cast<float>(node->number(1e-4, 1e4));
    if (const auto node = root.find("seed"))
        scene.seed = static_cast<std::uint32_t>(node->integer(0, seed_max));
    if (seed) scene.seed = *seed;
    read_light_and_camera(root, scene.settings);
    if (const auto node = root.find("materials")) read_materials(*node, scene.materials);
    water_settings_from(scene.materials, scene.settings);
    std::vector<BuildStep> steps;
    if (const auto node = root.find("build")) steps = read_build(*node, size, scene);
    try {
        scene.cells = Cells(size);
    } catch (const std::bad_alloc&) {
        root.need("size").refuse("a world of this size does not fit in memory", "a smaller size");
    }
    run_build(steps, scene);
    return scene;
}

Scene load_scene(const std::string& name_or_path, const Settings& base, std::optional<std::uint32_t> seed) {
    if (name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".json"))
        return parse_scene(read_text_file(name_or_path), name_or_path, base, seed);
    std::string names;
    for (const std::string& path : list_assets(scene_folder)) {
        if (asset_name(path) == name_or_path) return parse_scene(read_asset(path), path, base, seed);
        names += asset_name(path) + ", ";
    }
    fail("scene {}: no built-in scene of this name; allowed: {}or a path to a .json file",
         printable(name_or_path), names);
}

std::vector<SceneSummary> builtin_scenes() {
    std::vector<SceneSummary> scenes;
    for (const std::string& path : list_assets(scene_folder)) {
        const auto description = JsonNode::parse(read_asset(path), path).find("description");
        scenes.push_back({asset_name(path), description ? description->text() : ""});
    }
    return scenes;
}

}  // namespace tarn
