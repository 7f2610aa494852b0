// Ground from Perlin noise: a height for every column, and the materials below it. Knows no JSON.
//
// The keys of a scene file's `terrain` (README), all optional:
//   base_height_vox   mean height of the ground                                  [quarter of the world's
//   height] amplitude_vox     the noise reaches this far up and down                     [eighth of the
//   world's height] wavelength_vox    distance between hills of the first octave                 [64] octaves
//   1 to 10, each of half the wavelength                       [5] persistence       0 to 1, height of an
//   octave over that of the one before    [0.5] ridged            0 rolling hills to 1 sharp crests [0]
//   warp_vox          bends outlines of hills and shapes by up to this much      [0]
//   salt              a whole number: another ground from the same seed          [0]
//   shapes            a list, applied in order, that pulls the ground to a height: basins, valleys, cliffs,
//   hills
//     center [x,z], radius [rx,rz], height_vox
//     core            share of the radius with the full pull; 0.9 makes a cliff, 0 a bowl  [0.3]
//     weight          0 to 1, the full pull; below 1 some of the noise stays     [1]
//   top, under, rock  materials: the surface, below it, and deeper               [grass, dirt, stone]
//   under_depth_vox   thickness of `under`                                       [3]
//   rock_slope        a step to a neighbour of at least this many voxels bares the rock  [3]
//   bare_height_vox   rock lies bare above this height, more or less 3 voxels    [never]
//   beach             {material [sand], height_vox: reaches up to here, wobble_vox: more or less [1],
//                     depth_vox: thickness [2]}; its slope is at most 45 degrees, so sand lies at rest
//   patches           {material, wavelength_vox [12], cover 0 to 1 [0.3]} in place of `top` here and there
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
