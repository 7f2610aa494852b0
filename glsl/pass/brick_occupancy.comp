// What the bricks that changed hold: r 1 where a cell is not air, g 1 where a cell is not full water (or lies
// beyond the world), and whether they hold what moves and room for it. An invocation a brick. Bricks with another answer than before
// are boxed in for the distances.
#include "shared/materials.h"
#include "lib/distance_boxes.glsl"
#include "lib/matter.glsl"
#include "lib/new_changes.glsl"

layout(local_size_x = CHANGES_PER_GROUP) in;

layout(binding = BINDING_CELLS) uniform usampler3D cells;
layout(rg8ui, binding = 0) uniform uimage3D occupancy;

uniform ivec3 size_bricks;

void main() {
    uint item = new_change_item();
    if (!is_new_change(item)) return;
    uint id = new_change(item);
    uvec3 bricks = uvec3(size_bricks);
    ivec3 brick = ivec3(id % bricks.x, id / bricks.x % bricks.y, id / (bricks.x * bricks.y));
    ivec3 first = brick * BRICK_SIDE;
    bool cut = any(greaterThan(first + BRICK_SIDE, textureSize(cells, 0)));
    ivec3 size = min(textureSize(cells, 0) - first, ivec3(BRICK_SIDE));
    uvec2 holds = uvec2(0u, cut ? 1u : 0u);
    bool moves = false;
    bool room = false;
    int count = size.x * size.y * size.z;
    for (int i = 0; i < count && !(moves && room && holds == uvec2(1u)); ++i) {
        uint cell = texelFetch(cells, first + ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y)), 0).r;
        if (cell != MATERIAL_AIR) holds.r = 1u;
        if (cell != MATERIAL_WATER_FULL) holds.g = 1u;
        bool movable = is_water(cell) || cell == MATERIAL_SAND;
        moves = moves || movable;
        room = room || cell == MATERIAL_AIR || (movable && cell != MATERIAL_WATER_FULL);
    }
    // Loops that run at most once: llvmpipe runs the body of a branch, atomics and all, for lanes that do not take it.
    int word = matter_word(brick, size_bricks);
    uint bit = 1u << (brick.x & 31);
    bool moved = (matter[word].moves & bit) != 0u;
    bool had_room = (matter[word].room & bit) != 0u;
    for (bool begins = moves && !moved; begins; begins = false) atomicOr(matter[word].moves, bit);
    for (bool ends = moved && !moves; ends; ends = false) atomicAnd(matter[word].moves, ~bit);
    for (bool begins = room && !had_room; begins; begins = false) atomicOr(matter[word].room, bit);
    for (bool ends = had_room && !room; ends; ends = false) atomicAnd(matter[word].room, ~bit);
    for (bool flips = imageLoad(occupancy, brick).rg != holds; flips; flips = false) {
        imageStore(occupancy, brick, uvec4(holds, 0u, 0u));
        for (int k = 0; k < 3; ++k) {
            for (bool grows = brick[k] < flips_low[k]; grows; grows = false) atomicMin(flips_low[k], brick[k]);
            for (bool grows = brick[k] > flips_high[k]; grows; grows = false) atomicMax(flips_high[k], brick[k]);
        }
    }
}
