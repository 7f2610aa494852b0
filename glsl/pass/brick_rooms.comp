// One axis of the clear rooms ahead of bricks (shared/rooms.h), in the order y, x, z. An invocation a line of bricks
// that is marked: it goes along the line both ways and counts the levels whose room is clear so far. Where a count
// changed, the line of the next axis is marked.
#include "shared/bindings.h"
#include "shared/rooms.h"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;

layout(binding = BINDING_FIRST_INPUT) uniform usampler3D source;  // y: occupancy; else the axis before
#if AXIS == 1
layout(rg8ui, binding = 0) uniform uimage3D target;  // r: air, g: water; 4 bits a count, from bit 4 b
#endif
#if AXIS == 0
layout(rg16ui, binding = 0) uniform uimage3D target;  // the same, from bit 4 (a + 2 b)
#endif
#if AXIS == 2
layout(rg32ui, binding = 0) uniform uimage3D target;  // the words
#endif

layout(std430, binding = STORAGE_ROOM_LINES) buffer Lines { uint marked[]; };

uniform ivec3 size_bricks;
uniform uint version;

// Length of a room along this axis.
int room_length(int level) { return AXIS == 1 ? room_up(level) : room_across(level); }

// Of every brick beyond the world, for rays in air.
const int BEYOND = 4096;

// Nearest bricks ahead along the line that stop a room of each level.
struct Stops {
    ivec4 low, high;
};

// The count at `i` for the stops ahead, which the brick itself joins where fewer than `levels` are clear in it.
uint count_of(inout Stops stops, int i, uint levels) {
    stops.low = mix(stops.low, ivec4(i), lessThanEqual(uvec4(levels), uvec4(0u, 1u, 2u, 3u)));
    stops.high = mix(stops.high, ivec4(i), lessThanEqual(uvec4(levels), uvec4(4u, 5u, 6u, 7u)));
    ivec4 low = ivec4(room_length(0), room_length(1), room_length(2), room_length(3));
    ivec4 high = ivec4(room_length(4), room_length(5), room_length(6), room_length(7));
    ivec4 passed =
        ivec4(greaterThanEqual(abs(stops.low - i), low)) + ivec4(greaterThanEqual(abs(stops.high - i), high));
    return uint(passed.x + passed.y + passed.z + passed.w);
}

#if AXIS == 1
const int WAYS = 1;  // of the axes before
#endif
#if AXIS == 0
const int WAYS = 2;
#endif
#if AXIS == 2
const int WAYS = 4;
#endif

// Counts of all ways at a brick, 4 bits each.
uint counts_before(ivec3 brick, int medium) {
    uvec2 value = texelFetch(source, brick, 0).rg;
    uint counts = medium == 0 ? value.r : value.g;
#if AXIS == 1
    return counts == 0u ? uint(ROOM_LEVELS) : 0u;
#else
    return counts;
#endif
}

void walk(ivec3 brick, int medium, bool rises) {
    int n = size_bricks[AXIS];
    int beyond = rises ? (medium == 0 ? n + BEYOND : n) : (medium == 0 ? -1 - BEYOND : -1);
    Stops stops[WAYS];
    for (int way = 0; way < WAYS; ++way) stops[way] = Stops(ivec4(beyond), ivec4(beyond));
    for (int k = 0; k < n; ++k) {
        int i = rises ? n - 1 - k : k;
        brick[AXIS] = i;
        uint before = counts_before(brick, medium);
        uint counts[WAYS];
        for (int way = 0; way < WAYS; ++way) counts[way] = count_of(stops[way], i, before >> (4 * way) & 15u);
#if AXIS == 2
        if (counts[0] == 0u) continue;  // not clear: its word is a mask
        uint levels = 0u;
        for (int way = 0; way < WAYS; ++way) levels |= (counts[way] - 1u) << (3 * way);
        ivec3 at = brick + ivec3(0, 0, medium * size_bricks.z);
        uint other = imageLoad(target, at).r & (rises ? 0xfffu : 0xfff000u);
        imageStore(target, at, uvec4(other | levels << (rises ? 12 : 0), ROOM_CLEAR, 0u, 0u));
#else
        // Along y: bit 4 b. Along x: bit 4 (a + 2 b).
        uint mine = 0u;
        uint kept = 0u;
        for (int way = 0; way < WAYS; ++way) {
            int shift = 4 * (AXIS == 1 ? int(rises) : int(rises) + 2 * way);
            mine |= counts[way] << shift;
            kept |= 15u << shift;
        }
        uvec2 old = imageLoad(target, brick).rg;
        uint old_one = medium == 0 ? old.r : old.g;
        if ((old_one & kept) == mine) continue;
        uint new_one = (old_one & ~kept) | mine;
        imageStore(target, brick, uvec4(medium == 0 ? uvec2(new_one, old.g) : uvec2(old.r, new_one), 0u, 0u));
        int lines_y = size_bricks.x * size_bricks.z;
#if AXIS == 1
        marked[lines_y + brick.y + size_bricks.y * brick.z] = version;
#else
        marked[lines_y + size_bricks.y * size_bricks.z + brick.x + size_bricks.x * brick.y] = version;
#endif
#endif
    }
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
#if AXIS == 1
    ivec3 brick = ivec3(at.x, 0, at.y);
    int line = at.x + size_bricks.x * at.y;
#endif
#if AXIS == 0
    ivec3 brick = ivec3(0, at.x, at.y);
    int line = size_bricks.x * size_bricks.z + at.x + size_bricks.y * at.y;
#endif
#if AXIS == 2
    ivec3 brick = ivec3(at.x, at.y, 0);
    int line = size_bricks.x * size_bricks.z + size_bricks.y * size_bricks.z + at.x + size_bricks.x * at.y;
#endif
    if (any(greaterThanEqual(brick, size_bricks))) return;
    if (marked[line] != version) return;
    for (int medium = 0; medium < 2; ++medium) {
        walk(brick, medium, false);
        walk(brick, medium, true);
    }
}
