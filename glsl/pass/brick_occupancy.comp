// What the bricks that changed hold, as shared/rooms.h lays it out. An invocation a brick. Where one became clear of
// air or of full water or ceased to be, its column is marked for brick_rooms.comp.
#include "shared/materials.h"
#include "shared/bindings.h"
#include "shared/rooms.h"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;

layout(binding = BINDING_CELLS) uniform usampler3D cells;
layout(r32ui, binding = 0) readonly uniform uimage3D brick_changed;
// r: 1 where a cell is not air, g: 1 where a cell is not full water or lies beyond the world.
layout(rg8ui, binding = 1) uniform uimage3D occupancy;
layout(rg32ui, binding = 2) writeonly uniform uimage3D brick_rooms;

// Indirect arguments of brick_rooms.comp, by axis: 0 groups until something changed.
layout(std430, binding = 0) writeonly buffer RoomGroups { uint groups[9]; };
// The version at which any cell last changed.
layout(std430, binding = 1) writeonly buffer LastChange { uint last_change; };
// Version at which lines of bricks were marked: along y (x fastest), then along x (y fastest), then along z (x fastest).
layout(std430, binding = 2) writeonly buffer Lines { uint marked[]; };

uniform ivec3 size_bricks;
uniform uvec3 line_groups;  // along x, y, z: ceil(size / 8)
uniform uint version;

void main() {
    ivec3 brick = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(brick, size_bricks))) return;
    if (imageLoad(brick_changed, brick).r != version) return;
    last_change = version;

    ivec3 first = brick * BRICK_SIDE;
    ivec3 size = min(textureSize(cells, 0) - first, ivec3(BRICK_SIDE));
    uvec2 water = uvec2(0u);
    uvec2 matter = uvec2(0u);
    for (int part = 0; part < 2; ++part) {
        uint not_air = 0u;
        uint not_water = 0u;
        for (int i = 0; i < 32; ++i) {
            ivec3 at = ivec3(i & 3, (i >> 2) & 3, (i >> 4) + 2 * part);
            bool within = all(lessThan(at, size));
            uint cell = texelFetch(cells, first + min(at, size - 1), 0).r;
            not_air |= within && cell != MATERIAL_AIR ? 1u << i : 0u;
            not_water |= !within || cell != MATERIAL_WATER_FULL ? 1u << i : 0u;
        }
        if (part == 0) {
            matter.x = not_air;
            water.x = not_water;
        } else {
            matter.y = not_air;
            water.y = not_water;
        }
    }
    uvec2 holds = uvec2(matter != uvec2(0u), water != uvec2(0u));
    uvec2 held = imageLoad(occupancy, brick).rg;
    // The rooms of a brick that stays clear are kept.
    for (int medium = 0; medium < 2; ++medium) {
        uvec2 mask = medium == 0 ? matter : water;
        uint full = medium == 0 ? holds.r : holds.g;
        if (full == 0u && (medium == 0 ? held.r : held.g) == 0u) continue;
        uvec2 word = full == 0u ? uvec2(0u, ROOM_CLEAR) : uvec2(room_word_x(mask.x, mask.y), mask.y);
        imageStore(brick_rooms, brick + ivec3(0, 0, medium * size_bricks.z), uvec4(word, 0u, 0u));
    }
    if (held == holds) return;
    imageStore(occupancy, brick, uvec4(holds, 0u, 0u));
    marked[brick.x + size_bricks.x * brick.z] = version;
    groups[0] = line_groups.y;
    groups[1] = line_groups.z;
    groups[3] = line_groups.x;
    groups[4] = line_groups.z;
    groups[6] = line_groups.x;
    groups[7] = line_groups.y;
    groups[2] = groups[5] = groups[8] = 1u;
}
