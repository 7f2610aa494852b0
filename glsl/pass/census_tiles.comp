// Lists the tiles of the census in which a brick changed, each once. An invocation a changed brick.
#include "lib/census_tiles.glsl"
#include "lib/new_changes.glsl"

layout(local_size_x = CHANGES_PER_GROUP) in;

uniform ivec3 size_bricks;

void main() {
    uint item = new_change_item();
    if (!is_new_change(item)) return;
    uint id = new_change(item);
    uvec3 bricks = uvec3(size_bricks);
    const uint side = uint(CENSUS_TILE / BRICK_SIDE);
    uvec3 tile = uvec3(id % bricks.x, id / bricks.x % bricks.y, id / (bricks.x * bricks.y)) / side;
    uvec3 count = (bricks + side - 1u) / side;
    uint index = tile.x + count.x * (tile.y + count.y * tile.z);
    // Loops that run at most once: llvmpipe runs the body of a branch, atomics and all, for lanes that do not take it.
    for (bool unlisted = tile_listed[index] == 0u; unlisted; unlisted = false)
        for (bool first = atomicExchange(tile_listed[index], 1u) == 0u; first; first = false) {
            uint slot = atomicAdd(stale_tiles.count, 1u);
            stale_tile_ids[slot] = index;
            atomicMax(stale_tiles.groups_x, min(slot + 1u, WORK_GROUPS_PER_ROW));
            if (slot % WORK_GROUPS_PER_ROW == 0u) atomicAdd(stale_tiles.groups_y, 1u);
        }
}
