// The blocks of one grid that run: of those awake, or of all where every brick is (ALL), those in which anything may
// move as the cells are now. An invocation a block.
#include "shared/water.h"
#include "lib/matter.glsl"
#include "lib/work_list.glsl"

layout(local_size_x = ACTIVE_PER_GROUP) in;

layout(std430, binding = STORAGE_BLOCKS) buffer Blocks {
    WorkHeader blocks;
    uint block_ids[];
};
#ifndef ALL
layout(std430, binding = STORAGE_AWAKE_BLOCKS) readonly buffer AwakeBlocks {
    WorkHeader awake_blocks;
    uint awake_block_ids[];
};
#endif

uniform ivec3 size_vox;
uniform ivec3 block_vox;
uniform ivec3 offset_vox;
uniform ivec3 count_blocks;

void main() {
    uint item = work_group() * ACTIVE_PER_GROUP + gl_LocalInvocationIndex;
    uvec3 count = uvec3(count_blocks);
#ifdef ALL
    if (item >= count.x * count.y * count.z) return;
    uint id = item;
#else
    if (item >= awake_blocks.count) return;
    uint id = awake_block_ids[item];
#endif
    ivec3 first = ivec3(id % count.x, id / count.x % count.y, id / (count.x * count.y)) * block_vox - offset_vox;
    ivec3 low = max(first, ivec3(0)) / BRICK_SIDE;
    ivec3 high = (min(first + block_vox, size_vox) - 1) / BRICK_SIDE;
    ivec3 size_bricks = (size_vox + BRICK_SIDE - 1) / BRICK_SIDE;
    uvec2 held = uvec2(0u);  // what moves, and room
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y && any(equal(held, uvec2(0u))); ++y)
            for (int x = low.x; x <= high.x; x = (x | 31) + 1) {
                MatterWord word = matter[matter_word(ivec3(x, y, z), size_bricks)];
                uint mask = (0xffffffffu >> (31 - min(high.x - (x & ~31), 31))) & (0xffffffffu << (x & 31));
                held |= uvec2(word.moves, word.room) & mask;
            }
    // A loop that runs at most once: llvmpipe runs the body of a branch, atomics and all, for lanes that do not take it.
    for (bool runs = all(notEqual(held, uvec2(0u))); runs; runs = false) {
        uint slot = atomicAdd(blocks.count, 1u);
        block_ids[slot] = id;
        atomicMax(blocks.groups_x, min(slot + 1u, WORK_GROUPS_PER_ROW));
        if (slot % WORK_GROUPS_PER_ROW == 0u) atomicAdd(blocks.groups_y, 1u);
    }
}
