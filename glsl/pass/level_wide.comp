// The wide blocks of the level and pressure tiers, WIDE_SIDE x 2 x WIDE_SIDE cells: their upper layer levels along x
// and z, so that a pool finds its level in ticks that grow with its length, not with the square. The lower layer only
// tells what stands. A workgroup a block, an invocation a line.
#define GRID_CELLS (WIDE_SIDE * WIDE_SIDE)
#include "shared/water.h"
#include "lib/level_block.glsl"

layout(local_size_x = WIDE_SIDE) in;

shared int water_here, room_here, changed;

void main() {
    if (work_group() >= blocks.count) return;
    ivec3 block = block_of_group();
    ivec3 corner = block * ivec3(WIDE_SIDE, WIDE_HEIGHT, WIDE_SIDE) - offset_vox + ivec3(0, 1, 0);
    uint chance = block_chance(block);
    int lane = int(gl_LocalInvocationID.x);
    if (lane == 0) {
        water_here = 0;
        room_here = 0;
        changed = 0;
    }
    barrier();
    bool water = false;
    bool room = false;
    for (int z = 0; z < WIDE_SIDE; ++z) {
        ivec3 cell = corner + ivec3(lane, 0, z);
        int content = load_content(cell);
        ivec3 below = cell - ivec3(0, 1, 0);
        int flags = is_open(content) ? support_of(load_content(below)) : 0;
#ifdef PRESSURE
        if (is_open(content)) {
            if (inside_world(below) && is_pressed(imageLoad(acting_head, below).r, below.y)) flags |= STANDS;
            if (inside_world(cell) && is_pressed(imageLoad(acting_head, cell).r, cell.y)) flags |= PRESSED;
        }
#endif
        grid[lane + WIDE_SIDE * z] = content | flags | content << BEFORE_SHIFT;
        water = water || (content > 0 && is_open(content));
        room = room || content < FULL;
    }
    if (water) atomicOr(water_here, 1);
    if (room) atomicOr(room_here, 1);
    barrier();
    if (water_here == 0 || room_here == 0) return;

    LineRule rule = LineRule(film_threshold, WIDE_LEAST_QUANTA, 1);
    for (int pass = 0; pass < 2; ++pass) {
        bool along_x = int(chance >> 30 & 1u) == pass;
        Line line = Line(along_x ? lane * WIDE_SIDE : lane, along_x ? 1 : WIDE_SIDE, WIDE_SIDE, 0);
        level_line(line, rule, line_chance(chance, along_x ? 0 : 1, 1, lane));
        if (changed_here) changed = 1;
        barrier();
    }
    if (changed == 0) return;

    for (int z = 0; z < WIDE_SIDE; ++z) {
        ivec3 cell = corner + ivec3(lane, 0, z);
        int content = content_in(grid[lane + WIDE_SIDE * z]);
        if (content == content_before(grid[lane + WIDE_SIDE * z])) continue;
        imageStore(cells, cell, uvec4(cell_of(content)));
        mark_changed(cell);
    }
}
