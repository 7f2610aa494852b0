// What the bricks that changed hold, as shared/rooms.h lays it out, and whether they hold what moves and room for it.
// An invocation a brick. Where one became clear of air or of full water or ceased to be, its column is marked for
// brick_rooms.comp.
#include "shared/materials.h"
#include "shared/bindings.h"
#include "shared/rooms.h"
#include "lib/matter.glsl"
#include "lib/new_changes.glsl"
#include "lib/room_lines.glsl"

layout(local_size_x = CHANGES_PER_GROUP) in;

layout(r8ui, binding = 2) readonly restrict uniform uimage3D cells;
// r: 1 where a cell is not air, g: 1 where a cell is not full water or lies beyond the world.
layout(rg8ui, binding = 0) uniform uimage3D occupancy;
layout(rg32ui, binding = 1) writeonly uniform uimage3D brick_rooms;

// Indirect arguments of brick_rooms.comp, by axis: 0 groups until something changed.
layout(std430, binding = STORAGE_ROOM_GROUPS) writeonly buffer RoomGroups { uint groups[9]; };

uniform ivec3 size_bricks;
uniform uvec3 line_groups;  // of brick_rooms.comp along x, y, z
uniform uvec3 run_groups;   // likewise where an invocation takes a run of lines

void main() {
    uint item = new_change_item();
    if (!is_new_change(item)) return;
    uint id = new_change(item);
    uvec3 bricks = uvec3(size_bricks);
    ivec3 brick = ivec3(id % bricks.x, id / bricks.x % bricks.y, id / (bricks.x * bricks.y));
    ivec3 first = brick * BRICK_SIDE;
    ivec3 size = min(imageSize(cells) - first, ivec3(BRICK_SIDE));
    uvec2 not_air = uvec2(0u);
    uvec2 not_water = uvec2(0u);
    bool moves = false;
    bool room = false;
    for (int i = 0; i < 64; ++i) {
        ivec3 at = ivec3(i & 3, (i >> 2) & 3, i >> 4);
        bool within = all(lessThan(at, size));
        uint cell = imageLoad(cells, first + min(at, size - 1)).r;
        uvec2 bit = uvec2(i < 32 ? 1u << i : 0u, i < 32 ? 0u : 1u << (i - 32));
        if (within && cell != MATERIAL_AIR) not_air |= bit;
        if (!within || cell != MATERIAL_WATER_FULL) not_water |= bit;
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
    uvec2 holds = uvec2(not_air != uvec2(0u), not_water != uvec2(0u));
    uvec2 held = imageLoad(occupancy, brick).rg;
    // The rooms of a brick that stays clear are kept.
    for (int medium = 0; medium < 2; ++medium) {
        uvec2 mask = medium == 0 ? not_air : not_water;
        uint full = medium == 0 ? holds.r : holds.g;
        if (full == 0u && (medium == 0 ? held.r : held.g) == 0u) continue;
        uvec2 stored = full == 0u ? uvec2(0u, ROOM_CLEAR) : uvec2(room_word_x(mask.x, mask.y), mask.y);
        imageStore(brick_rooms, brick + ivec3(0, 0, medium * size_bricks.z), uvec4(stored, 0u, 0u));
    }
    if (held == holds) return;
    imageStore(occupancy, brick, uvec4(holds, 0u, 0u));
    for (int medium = 0; medium < 2; ++medium)
        if ((medium == 0 ? held.r : held.g) != (medium == 0 ? holds.r : holds.g))
            mark_room_line(1, brick, size_bricks, medium, 0, ROOM_LEVELS - 1);
    groups[0] = run_groups.y;
    groups[1] = line_groups.z;
    groups[3] = run_groups.x;
    groups[4] = line_groups.z;
    groups[6] = run_groups.x;
    groups[7] = line_groups.y;
    groups[2] = groups[5] = groups[8] = 1u;
}
