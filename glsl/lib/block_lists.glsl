// The lists of blocks that run in a tick: one or two grids of blocks, of which those are listed in which anything may move.
#include "lib/matter.glsl"
#include "lib/work_list.glsl"

layout(std430, binding = STORAGE_BLOCKS) buffer Blocks {
    WorkHeader blocks;
    uint block_ids[];
};
layout(std430, binding = STORAGE_BLOCKS_WIDE) buffer WideBlocks {
    WorkHeader wide_blocks;
    uint wide_block_ids[];
};

uniform ivec3 size_vox;
uniform ivec3 block_vox[2];
uniform ivec3 offset_vox[2];
uniform ivec3 count_blocks[2];

// Whether anything may move in a block; false where it is not asked.
bool may_move(int grid, ivec3 block, bool asked) {
    ivec3 first = block * block_vox[grid] - offset_vox[grid];
    ivec3 low = max(first, ivec3(0)) / BRICK_SIDE;
    ivec3 high = min(first + block_vox[grid], size_vox) - 1;
    high /= BRICK_SIDE;
    ivec3 bricks = (size_vox + BRICK_SIDE - 1) / BRICK_SIDE;
    uvec2 held = asked ? uvec2(0u) : uvec2(1u);  // what moves, and room
    for (int z = low.z; z <= high.z && any(equal(held, uvec2(0u))); ++z)
        for (int y = low.y; y <= high.y && any(equal(held, uvec2(0u))); ++y)
            for (int x = low.x; x <= high.x && any(equal(held, uvec2(0u))); x = (x | 31) + 1) {
                MatterWord word = matter[matter_word(ivec3(x, y, z), bricks)];
                uint mask = (0xffffffffu >> (31 - min(high.x - (x & ~31), 31))) & (0xffffffffu << (x & 31));
                held |= (uvec2(word.moves, word.room) | word.always) & mask;
            }
    return asked && all(notEqual(held, uvec2(0u)));
}

// Loops that run at most once: llvmpipe runs the body of a branch, atomics and all, for lanes that do not take it.
void append_block(int grid, uint id, bool asked) {
    for (bool tall = asked && grid == 0; tall; tall = false) {
        uint slot = atomicAdd(blocks.count, 1u);
        block_ids[slot] = id;
        atomicMax(blocks.groups_x, min(slot + 1u, WORK_GROUPS_PER_ROW));
        if (slot % WORK_GROUPS_PER_ROW == 0u) atomicAdd(blocks.groups_y, 1u);
    }
    for (bool wide = asked && grid == 1; wide; wide = false) {
        uint slot = atomicAdd(wide_blocks.count, 1u);
        wide_block_ids[slot] = id;
        atomicMax(wide_blocks.groups_x, min(slot + 1u, WORK_GROUPS_PER_ROW));
        if (slot % WORK_GROUPS_PER_ROW == 0u) atomicAdd(wide_blocks.groups_y, 1u);
    }
}
