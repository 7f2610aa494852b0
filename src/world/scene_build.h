// The `build` list of a scene file: read into plain steps first, so that a mistake is found before a world is
// allocated, then run.
#pragma once
#include <variant>
#include <vector>

#include "world/json_node.h"
#include "world/scene.h"
#include "world/terrain.h"

namespace tarn {

struct FillBox {
    Box box;  // may reach outside the world
    std::uint8_t byte = MATERIAL_AIR;
};

// Cells whose centre lies within `radius_vox` of `center_vox`.
struct FillSphere {
    glm::dvec3 center_vox{0};
    double radius_vox = 0;
    std::uint8_t byte = MATERIAL_AIR;
};

using BuildStep = std::variant<Terrain, FillBox, FillSphere>;

// Reads `list`; springs and drains go to `scene`, whose world will be `size_vox`. Throws Error naming the
// place.
std::vector<BuildStep> read_build(const JsonNode& list, glm::ivec3 size_vox, Scene& scene);

// Runs the steps in order on scene.cells.
void run_build(const std::vector<BuildStep>& steps, Scene& scene);

// The id of the named material at `node`. Throws Error listing the names.
std::uint8_t read_material(const JsonNode& node);

}  // namespace tarn
