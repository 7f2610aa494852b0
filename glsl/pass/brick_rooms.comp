// One axis of the clear rooms ahead of bricks (shared/rooms.h), in the order y, x, z: for every brick the number of
// levels whose room is clear so far. An invocation goes along some lines of bricks, those that are marked, both ways,
// from as far ahead of what changed as a room reaches to as far behind. Where a count changed, the line of the next axis
// is marked.
#include "shared/bindings.h"
#include "shared/rooms.h"
#include "lib/room_lines.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;

// y: occupancy; else the axis before. Full water lies behind air, but in the occupancy.
#if AXIS == 1
layout(rg8ui, binding = 1) readonly restrict uniform uimage3D source;
layout(r8ui, binding = 0) restrict uniform uimage3D target;  // 4 bits a count, from bit 4 b
#endif
#if AXIS == 0
layout(r8ui, binding = 1) readonly restrict uniform uimage3D source;
layout(r16ui, binding = 0) restrict uniform uimage3D target;  // from bit 4 (a + 2 b)
#endif
#if AXIS == 2
layout(r16ui, binding = 1) readonly restrict uniform uimage3D source;
layout(rg32ui, binding = 0) restrict uniform uimage3D target;  // the words
#endif

uniform ivec3 size_bricks;

// Length of a room along this axis.
int room_length(int level) { return AXIS == 1 ? room_up(level) : room_across(level); }

// A byte a level, from the lowest.
#if AXIS == 1
const uvec2 LENGTHS = uvec2(0x02010101u, 0x20100804u);
#else
const uvec2 LENGTHS = uvec2(0x08040201u, 0x10101010u);
#endif
uvec2 levels_from(int level) {
    return uvec2(level < 4 ? 0xffffffffu << (8 * level) : 0u, level < 8 ? 0xffffffffu << (8 * max(level - 4, 0)) : 0u);
}
// 1 in each byte that is not zero; bytes are below 128.
uvec2 ones(uvec2 bytes) { return ((bytes + 0x7f7f7f7fu) >> 7) & 0x01010101u; }
int sum_of(uvec2 bytes) { return int(((bytes.x + bytes.y) * 0x01010101u) >> 24); }

// Levels clear at a brick for the axes before.
int count_before(ivec3 brick, int medium, int way) {
#if AXIS == 1
    return imageLoad(source, brick)[medium] == 0u ? ROOM_LEVELS : 0;
#else
    return int(imageLoad(source, brick + ivec3(0, 0, medium * size_bricks.z)).r >> (4 * way) & 15u);
#endif
}

// Sets the count of a brick for rooms that go up along the axis or down. `count` knows of the levels up to `top` only:
// none above has changed.
void set_count(ivec3 brick, int medium, int way, bool rises, int count, int top) {
    ivec3 at = brick + ivec3(0, 0, medium * size_bricks.z);
    uint old = imageLoad(target, at).r;
#if AXIS == 2
    int shift = 3 * (way + (rises ? 4 : 0));
    int old_count = int(old >> shift & 7u) + 1;
#else
    int part = (rises ? 1 : 0) + 2 * way;
    int shift = 4 * part;
    int old_count = int(old >> shift & 15u);
#endif
    if (count > top) count = max(count, old_count);
#if AXIS == 2
    if (count == 0 || count == old_count) return;  // not clear: its word is a mask
    uint kept = old & ~(7u << shift);
    imageStore(target, at, uvec4(kept | uint(count - 1) << shift, ROOM_CLEAR, 0u, 0u));
#else
    if (count == old_count) return;
    uint kept = old & ~(15u << shift);
    imageStore(target, at, uvec4(kept | uint(count) << shift, 0u, 0u, 0u));
    mark_room_line(AXIS == 1 ? 0 : 2, brick, size_bricks, medium, part, max(count, old_count) - 1);
#endif
}

// Against the rays. `first` and `last`: the bricks between which counts before changed, in that order.
void walk(ivec3 brick, int medium, int way, bool rises, int first, int last, int top) {
    int n = size_bricks[AXIS];
    int onward = rises ? -1 : 1;
    int reach = room_length(top);
    int ahead = rises ? n - 1 - first : first;  // bricks of the world
    // For how many bricks to come each level is stopped by one that has been passed.
    uvec2 stopped = medium == 1 && ahead < reach - 1 ? LENGTHS : uvec2(0u);
    int between = abs(last - first);
    uvec2 known = ~levels_from(top + 1);
    int end = rises ? first + 1 : n - first;
    for (int k = -min(ahead, reach - 1); k < min(between + reach, end); ++k) {
        brick[AXIS] = first + onward * k;
        int before = count_before(brick, medium, way);
        uvec2 stops = levels_from(before);
        stopped = (stopped - ones(stopped)) & ~stops | LENGTHS & stops;
        // Behind the change, levels that this brick stops itself are as they were.
        if (k > between) reach = min(reach, before == 0 ? 0 : room_length(before - 1));
        if (k >= 0) set_count(brick, medium, way, rises, top + 1 - sum_of(ones(stopped & known)), top);
    }
}

void main() {
    // Even rows of groups, then odd ones: llvmpipe gives each thread a run of groups, and a change is often all in one.
    uint even = (gl_NumWorkGroups.y + 1u) / 2u;
    uint group = gl_WorkGroupID.y;
    uint row = group < even ? 2u * group : 2u * (group - even) + 1u;
    // Along y and z neighbouring lanes take neighbouring lines, as those that are marked lie side by side; along x that
    // took up to twice as long, for lines of other threads share a cache line.
    bool apart = AXIS == 0;
    int stride = apart ? 1 : int(gl_WorkGroupSize.x);
    ivec2 at = ivec2(ROOM_LINES_AN_INVOCATION * gl_WorkGroupSize.x * gl_WorkGroupID.x +
                         gl_LocalInvocationID.x * (apart ? ROOM_LINES_AN_INVOCATION : 1),
                     row * gl_WorkGroupSize.y + gl_LocalInvocationID.y);
    ivec3 first_brick = AXIS == 1 ? ivec3(at.x, 0, at.y) : AXIS == 0 ? ivec3(0, at.x, at.y) : ivec3(at.x, at.y, 0);
    int beside = AXIS == 0 ? 1 : 0;  // the axis from line to line
    // A round for each marked line and each of its parts: few are, and a round costs those that have none as well.
    uint marked = 0u;
    for (int i = 0; i < ROOM_LINES_AN_INVOCATION; ++i) {
        ivec3 brick = first_brick;
        brick[beside] += stride * i;
        bool within = all(lessThan(brick, size_bricks));
        int line = room_line_at(AXIS, min(brick, size_bricks - 1), size_bricks);
        marked |= within && room_lines[line] != 0u ? 1u << i : 0u;
    }
    while (marked != 0u) {
        ivec3 brick = first_brick;
        brick[beside] += stride * findLSB(marked);
        int line = room_line_at(AXIS, brick, size_bricks);
        uint parts = room_lines[line];
        int part = findLSB(parts);
        parts &= parts - 1u;
        room_lines[line] = parts;
        if (parts == 0u) marked &= marked - 1u;
        int range = line + 1 + 3 * part;
        int low = ROOM_LINE_END - int(room_lines[range]);
        int high = int(room_lines[range + 1]) - 1;
        int top = int(room_lines[range + 2]) - 1;
        room_lines[range] = room_lines[range + 1] = room_lines[range + 2] = 0u;
        int medium = part / room_line_ways(AXIS);
        int way = part % room_line_ways(AXIS);
        for (int i = 0; i < 2; ++i) walk(brick, medium, way, i == 1, i == 1 ? high : low, i == 1 ? low : high, top);
    }
}
