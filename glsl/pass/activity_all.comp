// The blocks of a tick in which every brick is awake. An invocation a block of one grid.
#include "shared/water.h"
#include "lib/block_lists.glsl"

layout(local_size_x = ACTIVE_PER_GROUP) in;

uniform int grid;

void main() {
    uint id = work_group() * ACTIVE_PER_GROUP + gl_LocalInvocationIndex;
    uvec3 count = uvec3(count_blocks[grid]);
    if (id >= count.x * count.y * count.z) return;
    ivec3 block = ivec3(id % count.x, id / count.x % count.y, id / (count.x * count.y));
    append_block(grid, id, may_move(grid, block, true));
}
