// Counts the cells of each byte in the tiles where some changed, and corrects the counts of the world by the difference.
// A workgroup a tile; an invocation walks columns and adds each run of equal bytes at once, to the workgroup's counters.
#include "lib/census_tiles.glsl"

#define COLUMNS 8
layout(local_size_x = COLUMNS, local_size_y = 1, local_size_z = COLUMNS) in;

layout(binding = BINDING_CELLS) uniform usampler3D cells;
// Of the world, by byte. At most 2^30 cells: 32 bits hold every count.
layout(std430, binding = 0) buffer CellCounts { uint counts[256]; };
// Of each tile.
layout(std430, binding = STORAGE_TILE_COUNTS) buffer TileCounts { uint tile_counts[]; };

shared uint local_counts[256];

void main() {
    bool listed = work_group() < stale_tiles.count;
    uint index = listed ? stale_tile_ids[work_group()] : 0u;
    for (uint i = gl_LocalInvocationIndex; i < 256u; i += COLUMNS * COLUMNS) local_counts[i] = 0u;
    barrier();
    ivec3 size = textureSize(cells, 0);
    uvec3 tiles = uvec3((size + CENSUS_TILE - 1) / CENSUS_TILE);
    ivec3 first = ivec3(index % tiles.x, index / tiles.x % tiles.y, index / (tiles.x * tiles.y)) * CENSUS_TILE;
    ivec3 end = listed ? min(first + CENSUS_TILE, size) : first;
    for (int z = first.z + int(gl_LocalInvocationID.z); z < end.z; z += COLUMNS)
        for (int x = first.x + int(gl_LocalInvocationID.x); x < end.x; x += COLUMNS) {
            uint run_byte = 0u;
            uint run = 0u;
            for (int y = first.y; y < end.y; ++y) {
                uint byte = texelFetch(cells, ivec3(x, y, z), 0).r;
                if (byte != run_byte && run > 0u) {
                    atomicAdd(local_counts[run_byte], run);
                    run = 0u;
                }
                run_byte = byte;
                ++run;
            }
            if (run > 0u) atomicAdd(local_counts[run_byte], run);
        }
    barrier();
    if (!listed) return;
    if (gl_LocalInvocationIndex == 0u) tile_listed[index] = 0u;
    for (uint i = gl_LocalInvocationIndex; i < 256u; i += COLUMNS * COLUMNS) {
        uint now = local_counts[i];
        uint before = tile_counts[256u * index + i];
        // Differences below zero wrap, and so does the sum.
        for (bool differs = now != before; differs; differs = false) {
            tile_counts[256u * index + i] = now;
            atomicAdd(counts[i], now - before);
        }
    }
}
