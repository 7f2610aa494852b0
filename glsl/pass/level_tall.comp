// The tall blocks of the level and pressure tiers, TALL_SIDE x TALL_HEIGHT x TALL_SIDE cells: water falls, sand sinks
// and slides, lines level along x and z or along the diagonals; with PRESSURE confined water is pressed on. A
// workgroup a block, an invocation a column, then a line.
#define GRID_CELLS (TALL_SIDE * TALL_SIDE * TALL_HEIGHT)
#include "shared/water.h"
#include "lib/level_block.glsl"

layout(local_size_x = TALL_INVOCATIONS) in;

uniform bool diagonal;  // lines of this tick

const int LAYER = TALL_SIDE * TALL_SIDE;
const int HAS_WATER = 1;
const int HAS_SAND = 2;
shared int in_block;
// As levelling finds them: layers that hold water, and room for it, a bit each.
shared int wet_layers, roomy_layers;
// 1: a cell may hold something else than before: 0, as the block fell; 1 and 2, in a pass of levelling.
shared int changed_parts[3];

// At the end of a part of the tick; a barrier must follow before anyone asks.
void tell_changes(int part) {
    for (bool tells = changed_here; tells; tells = false) changed_parts[part] = 1;
    changed_here = false;
}

#ifdef PRESSURE
shared uint head[GRID_CELLS];
#endif

int index_of(int x, int y, int z) { return x + TALL_SIDE * z + LAYER * y; }

// A column: sand sinks, water falls, unless the head below holds it.
void fall(int upper_at, int upper_y, bool sinks_in_water) {
    int upper_cell = grid[upper_at];
    int lower_cell = grid[upper_at - LAYER];
    int upper = content_in(upper_cell);
    int lower = content_in(lower_cell);
    if (!is_open(lower)) return;
    int moved = 0;
    if (upper == SAND) {
        if (lower != 0 && !sinks_in_water) return;
        moved = SAND - lower;  // they change places
    } else if (is_open(upper) && upper > 0 && lower < FULL) {
#ifdef PRESSURE
        uint h = head[upper_at - LAYER];
        if (is_confined(h) && 2 * lower >= FULL &&
            height_of(h) >= surface_quarters(upper_y, upper) + HEAD_PER_VOXEL)
            return;
#endif
        moved = min(upper, FULL - lower);
    }
    // A loop that runs at most once: llvmpipe runs the body of a branch for lanes that do not take it.
    for (bool moves = moved != 0; moves; moves = false) {
        grid[upper_at] = upper_cell - moved;
        grid[upper_at - LAYER] = lower_cell + moved;
        changed_here = true;
    }
}

// Sand that rests slides to the bottom of a neighbouring column of its sub-block of 2x2x2.
void slide_sand(ivec3 first, uint sub) {
    uint way = hash4(sub, uint(first.x), uint(first.y), uint(first.z));
    for (uint k = 0u; k < 4u; ++k) {
        uint i = (k + way) & 3u;
        int at = index_of(first.x + int(i & 1u), first.y, first.z + int(i >> 1));
        if (content_in(grid[at + LAYER]) != SAND || is_open(content_in(grid[at]))) continue;
        bool z_first = (way >> (4u + k) & 1u) != 0u;
        for (uint s = 0u; s < 2u; ++s) {
            uint j = i ^ ((s == 0u) == z_first ? 2u : 1u);
            int to = index_of(first.x + int(j & 1u), first.y, first.z + int(j >> 1));
            int lower = content_in(grid[to]);
            if (!is_open(lower) || !is_open(content_in(grid[to + LAYER]))) continue;
            set_content(at + LAYER, lower);
            set_content(to, SAND);
            break;
        }
    }
}

// What each cell of this invocation's column stands on. Of the block's lowest layer only the world's floor is known.
// Adds to the layers that hold water (x) and room for it (y), a bit each.
void find_supports(int column, int world_y, inout ivec2 layers) {
    int below = CLOSED;
    bool below_pressed = false;
    for (int y = 0; y < TALL_HEIGHT; ++y) {
        int cell = grid[column + LAYER * y];
        int content = content_in(cell);
        layers |= ivec2(content > 0 && is_open(content), content < FULL) << y;
        int flags = support_of(below);
        if (below_pressed) flags |= STANDS;
#ifdef PRESSURE
        below_pressed = is_pressed(head[column + LAYER * y], world_y + y);
        if (below_pressed) flags |= PRESSED;
#endif
        grid[column + LAYER * y] = (cell & ~FLAGS) | flags;
        below = content;
    }
}

// Where a diagonal step from a cell of this column passes between two closed cells. `step_x`: 1 or -1; z grows.
void find_cuts(ivec3 local, int step_x) {
    int x = local.x + step_x;
    bool within = x >= 0 && x < TALL_SIDE && local.z + 1 < TALL_SIDE;
    for (int y = 0; y < TALL_HEIGHT; ++y) {
        int at = index_of(local.x, y, local.z);
        int beside = within ? content_in(grid[at + step_x]) : 0;
        int behind = within ? content_in(grid[at + TALL_SIDE]) : 0;
        grid[at] = (grid[at] & ~CUT) | (is_open(beside) || is_open(behind) ? 0 : CUT);
    }
}

// Line `lane` of the block in one of four directions: 0 and 1 along x and z, 2 and 3 along the diagonals on which x
// rises and falls with z. Count 0 where there is none.
Line line_of(int lane, int direction, int lowest, out int y, out int number) {
    int lines = direction < 2 ? TALL_SIDE : 2 * TALL_SIDE - 1;
    number = lane % lines;
    y = lane / lines;
    bool none = y < lowest || y >= TALL_HEIGHT;
    if (direction == 0) return Line(index_of(0, y, number), 1, none ? 0 : TALL_SIDE, 0);
    if (direction == 1) return Line(index_of(number, y, 0), TALL_SIDE, none ? 0 : TALL_SIDE, 0);
    // Diagonals start on the side z = 0, then on the side where x does not change.
    bool rising = direction == 2;
    int along = min(number, TALL_SIDE - 1);
    ivec2 start = ivec2(rising ? TALL_SIDE - 1 - along : along, max(0, number - TALL_SIDE + 1));
    int count = min(rising ? TALL_SIDE - start.x : start.x + 1, TALL_SIDE - start.y);
    return Line(index_of(start.x, y, start.y), (rising ? 1 : -1) + TALL_SIDE, none ? 0 : count, 0);
}

#ifdef PRESSURE
// Confined water flows from the cell with more head, which keeps half.
void press_sideways(int from, int to, int y) {
    int giving = content_in(grid[from]);
    int taking = content_in(grid[to]);
    if (!is_open(giving) || !is_open(taking) || !is_pressed(head[to], y) || head[from] <= head[to]) return;
    int moved = min(max(0, giving - FULL / 2), FULL - taking);
    grid[from] -= moved;
    grid[to] += moved;
}

void press_up(int lower, ivec3 upper_local, int upper_y, uint chance) {
    int upper = lower + LAYER;
    int giving = content_in(grid[lower]);
    int taking = content_in(grid[upper]);
    uint h = head[lower];
    if (!is_open(giving) || !is_open(taking) || !is_confined(h) || taking == FULL || giving == 0) return;
    int height = surface_quarters(upper_y, taking);
    if (height_of(h) < height + HEAD_PER_VOXEL || head[upper] > h || upper_local.y + 1 >= TALL_HEIGHT) return;
    int moved = min(max(0, giving - FULL / 2), FULL - taking);
    if (content_in(grid[upper + LAYER]) == 0) {
        // A free surface rises slowly.
        if (giving < FULL) return;
        uint random = hash3(chance, uint(upper_local.x | upper_local.y << 8 | upper_local.z << 16), 0u) & 0xffffu;
        uint quanta_65536 =
            uint(height_of(h) - height) * (uint(FULL) * 65536u / uint(HEAD_PER_VOXEL * HEAD_RISE_TICKS));
        moved = min(moved, int((quanta_65536 + random) >> 16));
    }
    if (moved == 0) return;
    if (head[upper] == 0u) head[upper] = h - HEAD_STEP;
    grid[lower] -= moved;
    grid[upper] += moved;
}

// Water above that is nearer to the source flows down, whatever holds it.
void press_down(int upper) {
    int lower = upper - LAYER;
    int giving = content_in(grid[upper]);
    int taking = content_in(grid[lower]);
    if (!is_open(giving) || !is_open(taking) || !is_confined(head[lower]) || head[upper] <= head[lower]) return;
    int moved = min(giving, FULL - taking);
    grid[upper] -= moved;
    grid[lower] += moved;
}

// From the far end of each line towards the source, so that room travels the whole line.
void press(int axis, int lane, ivec3 corner, uint chance) {
    if (axis == 1) {
        ivec3 local = ivec3(lane % TALL_SIDE, 0, lane / TALL_SIDE);
        int column = index_of(local.x, 0, local.z);
        for (int y = TALL_HEIGHT - 2; y >= 0; --y)
            press_up(column + LAYER * y, ivec3(local.x, y + 1, local.z), corner.y + y + 1, chance);
        for (int y = 1; y < TALL_HEIGHT; ++y) press_down(column + LAYER * y);
        return;
    }
    int y = lane / TALL_SIDE;
    int j = lane % TALL_SIDE;
    int start = axis == 0 ? index_of(0, y, j) : index_of(j, y, 0);
    int stride = axis == 0 ? 1 : TALL_SIDE;
    for (int i = 0; i + 1 < TALL_SIDE; ++i)
        press_sideways(start + stride * (i + 1), start + stride * i, corner.y + y);
    for (int i = TALL_SIDE - 1; i > 0; --i)
        press_sideways(start + stride * (i - 1), start + stride * i, corner.y + y);
}
#endif

ivec3 local_of(int column) { return ivec3(column % TALL_SIDE, 0, column / TALL_SIDE); }

void main() {
    if (work_group() >= blocks.count) return;
    ivec3 block = block_of_group();
    ivec3 corner = block * ivec3(TALL_SIDE, TALL_HEIGHT, TALL_SIDE) - offset_vox;
    uint chance = block_chance(block);
    int lane = int(gl_LocalInvocationIndex);
    if (lane == 0) {
        in_block = 0;
        wet_layers = 0;
        roomy_layers = 0;
        changed_parts = int[3](0, 0, 0);
    }
    barrier();
    int found = 0;
    for (int column = lane; column < LAYER; column += TALL_INVOCATIONS)
        for (int y = 0; y < TALL_HEIGHT; ++y) {
            int content = load_content(corner + local_of(column) + ivec3(0, y, 0));
            grid[column + LAYER * y] = content | content << BEFORE_SHIFT;
            if (content > 0 && is_open(content)) found |= HAS_WATER;
            if (content == SAND) found |= HAS_SAND;
        }
    if (found != 0) atomicOr(in_block, found);
    barrier();
    int moving = in_block;
    if (moving == 0) return;

    for (int column = lane; column < LAYER; column += TALL_INVOCATIONS) {
#ifdef PRESSURE
        for (int y = 0; y < TALL_HEIGHT; ++y) {
            ivec3 cell = corner + local_of(column) + ivec3(0, y, 0);
            head[column + LAYER * y] = inside_world(cell) ? imageLoad(acting_head, cell).r : 0u;
        }
#endif
        // Where nothing falls in the first, nothing does in the second.
        bool changed_before = changed_here;
        changed_here = false;
        for (int y = 1; y < TALL_HEIGHT; ++y) fall(column + LAYER * y, corner.y + y, true);
        for (int y = 1; y < TALL_HEIGHT && changed_here; ++y) fall(column + LAYER * y, corner.y + y, false);
        changed_here = changed_here || changed_before;
    }
    tell_changes(0);
    barrier();
    if ((moving & HAS_SAND) != 0) {
        uint sub = hash2(chance, 99u);
        ivec3 start = ivec3(sub & 1u, sub >> 1 & 1u, sub >> 2 & 1u);
        for (int i = lane; i < GRID_CELLS / 8; i += TALL_INVOCATIONS) {
            ivec3 first = start + 2 * ivec3(i % 8, i / 8 % 4, i / 32);
            if (all(lessThan(first + 1, ivec3(TALL_SIDE, TALL_HEIGHT, TALL_SIDE)))) slide_sand(first, sub);
        }
        tell_changes(0);
        barrier();
    }
    if ((moving & HAS_WATER) != 0) {
        int lowest = corner.y == 0 ? 0 : 1;
        LineRule rule = LineRule(film_threshold, 0, diagonal ? 2 : 1);
        for (int pass = 0; pass < 2; ++pass) {
            int direction = diagonal ? (int(chance >> 29 & 1u) == pass ? 2 : 3)
                                     : (int(chance >> 30 & 1u) == pass ? 0 : 1);
            // What the first pass left as it was stands on what it stood on.
            bool stale = pass == 0 || changed_parts[1] != 0;
            ivec2 layers = ivec2(0);
            for (int column = stale ? lane : LAYER; column < LAYER; column += TALL_INVOCATIONS)
                find_supports(column, corner.y, layers);
            for (bool finds = any(notEqual(layers, ivec2(0))); finds; finds = false) {
                atomicOr(wet_layers, layers.x);
                atomicOr(roomy_layers, layers.y);
            }
            barrier();
            int live_layers = wet_layers & roomy_layers;
            for (int column = diagonal ? lane : LAYER; column < LAYER; column += TALL_INVOCATIONS)
                find_cuts(local_of(column), direction == 2 ? 1 : -1);
            barrier();
            int lines = (direction < 2 ? TALL_SIDE : 2 * TALL_SIDE - 1) * TALL_HEIGHT;
            for (int i = lane; i < lines; i += TALL_INVOCATIONS) {
                int y, number;
                Line line = line_of(i, direction, lowest, y, number);
                if ((live_layers >> y & 1) == 0) line.count = 0;
                level_line(line, rule, line_chance(chance, direction, y, number));
            }
            tell_changes(1 + pass);
            barrier();
        }
#ifdef PRESSURE
        int first_axis = int(chance >> 5 & 0xffu) % 3;
        for (int pass = 0; pass < 3; ++pass) {
            int axis = (first_axis + pass) % 3;
            for (int i = lane; i < (axis == 1 ? LAYER : TALL_SIDE * TALL_HEIGHT); i += TALL_INVOCATIONS)
                press(axis, i, corner, chance);
            barrier();
        }
#endif
    }

#ifndef PRESSURE
    if ((changed_parts[0] | changed_parts[1] | changed_parts[2]) == 0) return;
#endif
    for (int column = lane; column < LAYER; column += TALL_INVOCATIONS)
        for (int y = 0; y < TALL_HEIGHT; ++y) {
            ivec3 cell = corner + local_of(column) + ivec3(0, y, 0);
            int at = column + LAYER * y;
            int content = content_in(grid[at]);
            if (content == CLOSED) continue;
            if (content != content_before(grid[at])) {
                imageStore(cells, cell, uvec4(cell_of(content)));
                mark_changed(cell);
            }
#ifdef PRESSURE
            if (head[at] != imageLoad(acting_head, cell).r) imageStore(acting_head, cell, uvec4(head[at]));
#endif
        }
}
