// The bytes of a cell and the table of materials with their default optical properties; C++ and GLSL.
#ifndef TARN_SHARED_MATERIALS
#define TARN_SHARED_MATERIALS
#include "shared/language.h"

// X(CONSTANT, name, id, base_color r, g, b, roughness, metallic, ior, absorption_per_m r, g, b, emission r, g, b)
// base_color and metallic in [0,1]; alpha = roughness^2; ior of the interface towards air (1: none, bare Lambert);
// absorption per metre; emission is radiance. water: absorption of clear lake water, exaggerated in red for looks.
#define TARN_MATERIALS(X)                                                                              \
    X(MATERIAL_AIR, air, 0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)                \
    X(MATERIAL_STONE, stone, 1, 0.42, 0.40, 0.38, 0.8, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)         \
    X(MATERIAL_DIRT, dirt, 2, 0.34, 0.22, 0.13, 0.9, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)           \
    X(MATERIAL_GRASS, grass, 3, 0.16, 0.36, 0.07, 0.9, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)         \
    X(MATERIAL_SAND, sand, 4, 0.76, 0.63, 0.42, 0.9, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)           \
    X(MATERIAL_GLASS, glass, 5, 1.0, 1.0, 1.0, 0.0, 0.0, 1.5, 0.06, 0.02, 0.04, 0.0, 0.0, 0.0)         \
    X(MATERIAL_METAL, metal, 6, 0.91, 0.92, 0.92, 0.3, 1.0, 1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)         \
    X(MATERIAL_LAMP, lamp, 7, 0.8, 0.8, 0.8, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 12.0, 9.0, 5.5)             \
    X(MATERIAL_WALL, wall, 8, 0.73, 0.73, 0.73, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)           \
    X(MATERIAL_WATER, water, 64, 1.0, 1.0, 1.0, 0.0, 0.0, 1.333, 0.35, 0.07, 0.04, 0.0, 0.0, 0.0)

TARN_SHARED_BEGIN

#ifdef __cplusplus
#define TARN_DECLARE(CONSTANT, name, id, r, g, b, rough, metal, ior, ar, ag, ab, er, eg, eb) \
    constexpr std::uint8_t CONSTANT = id;
#else
#define TARN_DECLARE(CONSTANT, name, id, r, g, b, rough, metal, ior, ar, ag, ab, er, eg, eb) \
    const uint CONSTANT = uint(id);
#endif
TARN_MATERIALS(TARN_DECLARE)
#undef TARN_DECLARE

// Water of q quanta, q = 1..QUANTA_PER_VOXEL, is the byte MATERIAL_WATER + q - 1. Bytes above are free.
TARN_CONSTANT TARN_UINT QUANTA_PER_VOXEL = 16u;
TARN_CONSTANT TARN_UINT MATERIAL_WATER_FULL = 79u;  // MATERIAL_WATER + QUANTA_PER_VOXEL - 1
TARN_CONSTANT TARN_UINT MATERIAL_COUNT = 256u;

// True for a byte that holds water.
TARN_FUNCTION bool is_water(TARN_UINT cell) { return cell >= 64u && cell <= MATERIAL_WATER_FULL; }

// Quanta of water in a byte, 0..16.
TARN_FUNCTION TARN_UINT quanta_of(TARN_UINT cell) { return is_water(cell) ? cell - 63u : 0u; }

// The byte of `quanta` (0..16) of water; 0 is air.
TARN_FUNCTION TARN_UINT water_cell(TARN_UINT quanta) { return quanta == 0u ? 0u : 63u + quanta; }

// The material id of a byte: the byte without its amount.
TARN_FUNCTION TARN_UINT material_of(TARN_UINT cell) { return is_water(cell) ? 64u : cell; }

TARN_SHARED_END
#endif
