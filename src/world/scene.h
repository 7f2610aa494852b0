// A scene: what a scene file says. Documented for users in the README. Owns plain data only.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/settings.h"
#include "world/cells.h"
#include "world/material_table.h"

namespace tarn {

struct Box {  // cells min <= c < max
    glm::ivec3 min_vox{0}, max_vox{0};
    bool operator==(const Box&) const = default;
    glm::ivec3 size() const { return max_vox - min_vox; }
    std::uint64_t volume() const { return std::uint64_t{1} * size().x * size().y * size().z; }
};

// Makes `per_tick` quanta of water (voxels of sand) in its region before each step, spread evenly over its
// cells, min(share, room) made and counted.
struct Spring {
    Box region;
    std::uint8_t material = MATERIAL_WATER;  // MATERIAL_WATER or MATERIAL_SAND
    std::uint32_t per_tick = 0;              // up to 2^31
    bool operator==(const Spring&) const = default;
};

// Takes all water and sand in its region after each step.
struct Drain {
    Box region;
    bool operator==(const Drain&) const = default;
};

struct Scene {
    std::string name;
    std::string description;  // one line for `tarn scenes`
    std::uint32_t seed = 1;
    float metres_per_voxel = 0.25f;
    Cells cells;  // after `build`
    MaterialTable materials = default_materials();
    std::vector<Spring> springs;
    std::vector<Drain> drains;
    Settings settings;  // defaults with the scene's camera, sun, sky and water
};

// Reads a built-in scene by name or a scene file (a name with '/' or ending in .json is a file). `seed`
// overrides the file's. `base` supplies the settings that the scene does not set. Throws Error naming file,
// place and reason.
Scene load_scene(const std::string& name_or_path, const Settings& base,
                 std::optional<std::uint32_t> seed = {});

// The same from text; `origin` names it in errors.
Scene parse_scene(const std::string& text, const std::string& origin, const Settings& base,
                  std::optional<std::uint32_t> seed = {});

struct SceneSummary {
    std::string name, description;
};
std::vector<SceneSummary> builtin_scenes();

}  // namespace tarn
