// The active bricks of the step that begins: those that changed lately stay on the list, and the blocks of one or
// two grids that touch them or a neighbour are listed as awake. An invocation a brick.
#include "lib/activity.glsl"

layout(local_size_x = ACTIVE_PER_GROUP) in;

layout(std430, binding = STORAGE_ACTIVE) readonly buffer Active {
    WorkHeader awake;
    uint awake_bricks[];
};
// `mark` for a block on its list; those of the second grid follow those of the first.
layout(std430, binding = STORAGE_BLOCK_MARKS) coherent buffer BlockMarks { uint block_marks[]; };
layout(std430, binding = STORAGE_AWAKE_BLOCKS) buffer AwakeBlocks {
    WorkHeader awake_blocks;
    uint awake_block_ids[];
};
layout(std430, binding = STORAGE_AWAKE_BLOCKS_WIDE) buffer AwakeWideBlocks {
    WorkHeader awake_wide_blocks;
    uint awake_wide_block_ids[];
};

uniform ivec3 size_vox;
uniform uint mark;  // another in every step, so that nothing needs clearing
uniform int grids;
uniform ivec3 block_vox[2];
uniform ivec3 offset_vox[2];
uniform ivec3 count_blocks[2];

// Loops that run at most once: llvmpipe runs the body of a branch, atomics and all, for lanes that do not take it.
void mark_block(int grid, ivec3 block) {
    uint id = uint(block.x + count_blocks[grid].x * (block.y + count_blocks[grid].y * block.z));
    uint at = id;
    if (grid == 1) at += uint(count_blocks[0].x * count_blocks[0].y * count_blocks[0].z);
    for (bool unmarked = block_marks[at] != mark; unmarked; unmarked = false) {
        bool first = atomicExchange(block_marks[at], mark) != mark;
        for (bool tall = first && grid == 0; tall; tall = false) {
            uint slot = atomicAdd(awake_blocks.count, 1u);
            awake_block_ids[slot] = id;
            uint group = slot / ACTIVE_PER_GROUP;
            atomicMax(awake_blocks.groups_x, min(group + 1u, WORK_GROUPS_PER_ROW));
            if (slot % (ACTIVE_PER_GROUP * WORK_GROUPS_PER_ROW) == 0u) atomicAdd(awake_blocks.groups_y, 1u);
        }
        for (bool wide = first && grid == 1; wide; wide = false) {
            uint slot = atomicAdd(awake_wide_blocks.count, 1u);
            awake_wide_block_ids[slot] = id;
            uint group = slot / ACTIVE_PER_GROUP;
            atomicMax(awake_wide_blocks.groups_x, min(group + 1u, WORK_GROUPS_PER_ROW));
            if (slot % (ACTIVE_PER_GROUP * WORK_GROUPS_PER_ROW) == 0u) atomicAdd(awake_wide_blocks.groups_y, 1u);
        }
    }
}

void main() {
    uint item = work_group() * ACTIVE_PER_GROUP + gl_LocalInvocationID.x;
    if (item >= awake.count) return;
    uint id = awake_bricks[item];
    if (tick - changed_tick[id] > uint(SLEEP_TICKS)) return;
    append_active(id);

    uvec3 size = uvec3(size_bricks);
    ivec3 brick = ivec3(id % size.x, id / size.x % size.y, id / (size.x * size.y));
    ivec3 low = max((brick - 1) * BRICK_SIDE, ivec3(0));
    ivec3 high = min((brick + 2) * BRICK_SIDE, size_vox) - 1;
    for (int grid = 0; grid < grids; ++grid) {
        ivec3 first = (low + offset_vox[grid]) / block_vox[grid];
        ivec3 last = (high + offset_vox[grid]) / block_vox[grid];
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) mark_block(grid, ivec3(x, y, z));
    }
}
