#include "world/scene_build.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tarn {

namespace {

constexpr int coordinate_max_vox = 1000000;
constexpr double length_max_vox = 100000;

std::string material_names() {
    std::string names;
    for (const std::uint8_t id : named_materials())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", material_name(id));
    return names;
}

// The byte that `build` writes: water comes full.
std::uint8_t full_byte(std::uint8_t material) {
    return material == MATERIAL_WATER ? static_cast<std::uint8_t>(MATERIAL_WATER_FULL) : material;
}

Box read_box(const JsonNode& node) {
    const JsonNode max = node.need("max");
    const Box box{node.need("min").ivec3(-coordinate_max_vox, coordinate_max_vox),
                  max.ivec3(-coordinate_max_vox, coordinate_max_vox)};
    for (int axis = 0; axis < 3; ++axis) {
        if (box.min_vox[axis] >= box.max_vox[axis])
            max.items()[axis].refuse(
                fmt::format("{} is not above min {}", box.max_vox[axis], box.min_vox[axis]),
                "max above min on every axis (max itself is outside the box)");
    }
    return box;
}

// A region of a spring or drain, which must lie in the world.
Box read_region(const JsonNode& node, glm::ivec3 size) {
    const Box box = read_box(node);
    for (int axis = 0; axis < 3; ++axis) {
        if (box.min_vox[axis] < 0)
            node.need("min").items()[axis].refuse(fmt::format("{} is outside the world", box.min_vox[axis]),
                                                  fmt::format("0 to {}", size[axis] - 1));
        if (box.max_vox[axis] > size[axis])
            node.need("max").items()[axis].refuse(fmt::format("{} is outside the world", box.max_vox[axis]),
                                                  fmt::format("1 to {}", size[axis]));
    }
    return box;
}

template <typename T>
void read_number(const JsonNode& node, std::string_view key, double min, double max, T& value) {
    if (const auto child = node.find(key)) value = static_cast<T>(child->number(min, max));
}

void read_whole(const JsonNode& node, std::string_view key, int min, int max, int& value) {
    if (const auto child = node.find(key)) value = static_cast<int>(child->integer(min, max));
}

void read_solid(const JsonNode& node, std::string_view key, std::uint8_t& value) {
    const auto child = node.find(key);
    if (!child) return;
    value = full_byte(read_material(*child));
}

TerrainShape read_shape(const JsonNode& node) {
    node.allow_only({"center", "radius", "height_vox", "core", "weight"});
    TerrainShape shape;
    shape.center_vox = node.need("center").vec2(-coordinate_max_vox, coordinate_max_vox);
    shape.radius_vox = node.need("radius").vec2(0.5, length_max_vox);
    shape.height_vox = node.need("height_vox").number(-length_max_vox, length_max_vox);
    read_number(node, "core", 0, 1, shape.core);
    read_number(node, "weight", 0, 1, shape.weight);
    return shape;
}

Terrain read_terrain(const JsonNode& node, glm::ivec3 size) {
    node.allow_only({"base_height_vox", "amplitude_vox", "wavelength_vox", "octaves", "persistence", "ridged",
                     "warp_vox", "salt", "shapes", "top", "under", "rock", "under_depth_vox", "rock_slope",
                     "bare_height_vox", "beach", "patches"});
    Terrain terrain;
    terrain.base_height_vox = size.y / 4.0;
    terrain.amplitude_vox = size.y / 8.0;
    read_number(node, "base_height_vox", -length_max_vox, length_max_vox, terrain.base_height_vox);
    read_number(node, "amplitude_vox", 0, length_max_vox, terrain.amplitude_vox);
    read_number(node, "wavelength_vox", 1, length_max_vox, terrain.wavelength_vox);
    read_whole(node, "octaves", 1, 10, terrain.octaves);
    read_number(node, "persistence", 0, 1, terrain.persistence);
    read_number(node, "ridged", 0, 1, terrain.ridged);
    read_number(node, "warp_vox", 0, length_max_vox, terrain.warp_vox);
    read_whole(node, "salt", 0, coordinate_max_vox, terrain.salt);
    read_whole(node, "under_depth_vox", 0, world_side_max_vox, terrain.under_depth_vox);
    read_whole(node, "rock_slope", 1, world_side_max_vox, terrain.rock_slope);
    if (const auto bare = node.find("bare_height_vox"))
        terrain.bare_height_vox = bare->number(-length_max_vox, length_max_vox);
    read_solid(node, "top", terrain.top);
    read_solid(node, "under", terrain.under);
    read_solid(node, "rock", terrain.rock);
    if (const auto shapes = node.find("shapes")) {
        for (const JsonNode& shape : shapes->items()) terrain.shapes.push_back(read_shape(shape));
    }
    if (const auto beach = node.find("beach")) {
        beach->allow_only({"material", "height_vox", "wobble_vox", "depth_vox"});
        terrain.beach.emplace();
        read_solid(*beach, "material", terrain.beach->material);
        terrain.beach->height_vox = beach->need("height_vox").number(-length_max_vox, length_max_vox);
        read_number(*beach, "wobble_vox", 0, length_max_vox, terrain.beach->wobble_vox);
        read_whole(*beach, "depth_vox", 1, world_side_max_vox, terrain.beach->depth_vox);
    }
    if (const auto patches = node.find("patches")) {
        patches->allow_only({"material", "wavelength_vox", "cover"});
        terrain.patches.emplace();
        read_solid(*patches, "material", terrain.patches->material);
        read_number(*patches, "wavelength_vox", 1, length_max_vox, terrain.patches->wavelength_vox);
        read_number(*patches, "cover", 0, 1, terrain.patches->cover);
    }
    return terrain;
}

FillSphere read_sphere(const JsonNode& node) {
    node.allow_only({"center", "radius", "material"});
    return {node.need("center").vec3(-coordinate_max_vox, coordinate_max_vox),
            node.need("radius").number(0, length_max_vox), full_byte(read_material(node.need("material")))};
}

Spring read_spring(const JsonNode& node, glm::ivec3 size) {
    node.allow_only({"min", "max", "material", "per_tick"});
    Spring spring;
    spring.region = read_region(node, size);
    if (const auto material = node.find("material")) {
        spring.material = read_material(*material);
        if (spring.material != MATERIAL_WATER && spring.material != MATERIAL_SAND)
            material->refuse(fmt::format("a spring cannot make {}", material_name(spring.material)),
                             "water, sand");
    }
    spring.per_tick = static_cast<std::uint32_t>(node.need("per_tick").integer(0, std::int64_t{1} << 31));
    return spring;
}

void fill(const FillBox& step, Cells& cells) {
    const glm::ivec3 min = glm::max(step.box.min_vox, glm::ivec3(0));
    const glm::ivec3 max = glm::min(step.box.max_vox, cells.size_vox());
    for (int z = min.z; z < max.z; ++z) {
        for (int y = min.y; y < max.y; ++y) {
            for (int x = min.x; x < max.x; ++x) cells.at({x, y, z}) = step.byte;
        }
    }
}

void fill(const FillSphere& step, Cells& cells) {
    const double r = step.radius_vox;
    const glm::ivec3 min = glm::max(glm::ivec3(glm::floor(step.center_vox - r)), glm::ivec3(0));
    const glm::ivec3 max = glm::min(glm::ivec3(glm::ceil(step.center_vox + r)), cells.size_vox());
    for (int z = min.z; z < max.z; ++z) {
        for (int y = min.y; y < max.y; ++y) {
            for (int x = min.x; x < max.x; ++x) {
                const glm::dvec3 offset = glm::dvec3(x, y, z) + 0.5 - step.center_vox;
                if (glm::dot(offset, offset) <= r * r) cells.at({x, y, z}) = step.byte;
            }
        }
    }
}

}  // namespace

std::uint8_t read_material(const JsonNode& node) {
    const std::string name = node.text();
    const auto id = material_id(name);
    if (!id) node.refuse(fmt::format("unknown material \"{}\"", printable(name)), material_names());
    return *id;
}

std::vector<BuildStep> read_build(const JsonNode& list, glm::ivec3 size_vox, Scene& scene) {
    constexpr auto kinds = "one of terrain, box, sphere, spring, drain";
    std::vector<BuildStep> steps;
    for (const JsonNode& item : list.items()) {
        item.allow_only({"terrain", "box", "sphere", "spring", "drain"});
        const auto members = item.members();
        if (members.size() != 1)
            item.refuse(fmt::format("an object of {} keys where one key is needed", members.size()), kinds);
        const auto& [kind, node] = members.front();
        if (kind == "terrain") {
            steps.emplace_back(read_terrain(node, size_vox));
        } else if (kind == "box") {
            node.allow_only({"min", "max", "material"});
            steps.emplace_back(FillBox{read_box(node), full_byte(read_material(node.need("material")))});
        } else if (kind == "sphere") {
            steps.emplace_back(read_sphere(node));
        } else if (kind == "spring") {
            scene.springs.push_back(read_spring(node, size_vox));
        } else {
            node.allow_only({"min", "max"});
            scene.drains.push_back({read_region(node, size_vox)});
        }
    }
    return steps;
}

void run_build(const std::vector<BuildStep>& steps, Scene& scene) {
    for (const BuildStep& step : steps) {
        if (const auto* terrain = std::get_if<Terrain>(&step))
            build_terrain(*terrain, scene.seed, scene.cells);
        else if (const auto* box = std::get_if<FillBox>(&step))
            fill(*box, scene.cells);
        else
            fill(std::get<FillSphere>(step), scene.cells);
    }
}

}  // namespace tarn
