// The blocks of the level and pressure tiers, one workgroup each: which block runs, and how its cells are read.
#include "lib/activity.glsl"
#include "lib/level_line.glsl"

layout(r8ui, binding = IMAGE_CELLS) uniform uimage3D cells;
#ifdef PRESSURE
#include "lib/head.glsl"
layout(r32ui, binding = IMAGE_ACTING_HEAD) uniform uimage3D acting_head;
#endif

layout(std430, binding = STORAGE_BLOCKS) readonly buffer Blocks {
    WorkHeader blocks;
    uint block_ids[];
};

uniform ivec3 size_vox;
uniform ivec3 offset_vox;
uniform ivec3 count_blocks;
uniform uint seed;
uniform int film_threshold;

bool inside_world(ivec3 cell) { return all(lessThan(uvec3(cell), uvec3(size_vox))); }

int load_content(ivec3 cell) { return inside_world(cell) ? content_of(imageLoad(cells, cell).r) : CLOSED; }

ivec3 block_of_group() {
    uint id = block_ids[work_group()];
    uvec3 count = uvec3(count_blocks);
    return ivec3(id % count.x, id / count.x % count.y, id / (count.x * count.y));
}

uint block_chance(ivec3 block) { return hash4(seed, tick, uint(block.x | block.z << 16), uint(block.y)); }

// Flags of a cell over one that holds `below`.
int support_of(int below) { return (supports(below) ? STANDS : 0) | (is_open(below) ? ON_WATER : 0); }
