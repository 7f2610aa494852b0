// Ground from Perlin noise: a height for every column, and the materials below it. Knows no JSON.
//
// The keys of a scene file's `terrain` and their defaults are in the README.
// Ground replaces what earlier items built below its surface and leaves what lies above: a box of water
// before the terrain is a lake in its valleys.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "world/cells.h"

namespace tarn {

struct TerrainShape {
    glm::dvec2 center_vox{0}, radius_vox{1};  // x, z
    double height_vox = 0, core = 0.3, weight = 1;
};

struct TerrainBeach {
    std::uint8_t material = MATERIAL_SAND;
    double height_vox = 0, wobble_vox = 1;
    int depth_vox = 2;
};

struct TerrainPatches {
    std::uint8_t material = MATERIAL_DIRT;
    double wavelength_vox = 12, cover = 0.3;
};

struct Terrain {
    double base_height_vox = 16, amplitude_vox = 8, wavelength_vox = 64;
    int octaves = 5;
    double persistence = 0.5, ridged = 0, warp_vox = 0;
    int salt = 0;
    std::vector<TerrainShape> shapes;
    std::uint8_t top = MATERIAL_GRASS, under = MATERIAL_DIRT, rock = MATERIAL_STONE;
    int under_depth_vox = 3, rock_slope = 3;
    std::optional<double> bare_height_vox;
    std::optional<TerrainBeach> beach;
    std::optional<TerrainPatches> patches;
};

void build_terrain(const Terrain& terrain, std::uint32_t seed, Cells& cells);

}  // namespace tarn
