// The tiles by which cells are counted: those to count anew, and what each held when it was. src/passes/census.h owns
// the buffers.
#include "shared/bindings.h"
#include "lib/work_list.glsl"

layout(std430, binding = STORAGE_STALE_TILES) coherent buffer StaleTiles {
    WorkHeader stale_tiles;
    uint stale_tile_ids[];
};
// 1: is on that list.
layout(std430, binding = STORAGE_TILE_LISTED) coherent buffer TileListed { uint tile_listed[]; };
