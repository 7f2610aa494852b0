// One step of the `block` tier: an invocation owns a block of 2x2x2 cells, reads them, moves water and sand among
// them and writes those that changed. Cells outside the world are wall. A workgroup runs a tile of BLOCK_TILE cells a
// side.
#include "shared/hash.h"
#include "lib/activity.glsl"
#include "lib/water.glsl"

layout(local_size_x = BLOCK_TILE / 2, local_size_y = BLOCK_TILE / 2, local_size_z = BLOCK_TILE / 2) in;

layout(r8ui, binding = IMAGE_CELLS) uniform uimage3D cells;

layout(std430, binding = STORAGE_BLOCKS) readonly buffer Tiles {
    WorkHeader tiles;
    uint tile_ids[];
};

uniform ivec3 size_vox;
uniform ivec3 offset_vox;      // 0 or 1 along each axis
uniform ivec3 count_tiles;
uniform uint seed;
uniform uint tick_key;         // hash2(seed, tick)
uniform int film_threshold;    // quanta

// A column: water falls as far as there is room, sand sinks through air and water.
void fall(inout int upper, inout int lower) {
    if (!is_open(lower)) return;
    if (upper == SAND) {
        upper = lower;
        lower = SAND;
    } else if (is_open(upper)) {
        int moved = min(upper, FULL - lower);
        upper -= moved;
        lower += moved;
    }
}

// Sand that rests slides down beside its column where that is open; what was there rises into its place.
void slide(inout int from_upper, int from_lower, int to_upper, inout int to_lower) {
    if (from_upper != SAND || is_open(from_lower) || !is_open(to_upper) || !is_open(to_lower)) return;
    from_upper = to_lower;
    to_lower = SAND;
}

// Two neighbours of one layer: supported ones level, one over a drop takes what it can hold.
void level(inout int a, inout int b, bool a_supported, bool b_supported) {
    if (!is_open(a) || !is_open(b)) return;
    int total = a + b;
    if (a_supported && b_supported) {
        if (abs(a - b) <= 1 || (min(a, b) == 0 && total < 2 * film_threshold)) return;
        a = total / 2;
        b = total - a;
    } else if (a_supported) {
        b = min(total, FULL);
        a = total - b;
    } else if (b_supported) {
        a = min(total, FULL);
        b = total - a;
    }
}

// The four cells 0 1 / 2 3 of one layer. Where all stand, one tick in four (`as_one`) levels them at once: pairs
// alone spread into diamonds, squares alone into squares.
void level_layer(inout int c[4], bvec4 supported, bool as_one) {
    int most = max(max(c[0], c[1]), max(c[2], c[3]));
    int least = min(min(c[0], c[1]), min(c[2], c[3]));
    if (as_one && all(supported) && is_open(most)) {
        if (most - least <= 1) return;
        int total = c[0] + c[1] + c[2] + c[3];
        if (least > 0 || total >= 4 * film_threshold) {
            for (int k = 0; k < 4; ++k) c[k] = (total + 3 - k) / 4;
            return;
        }
    }
    level(c[0], c[1], supported.x, supported.y);
    level(c[2], c[3], supported.z, supported.w);
    level(c[0], c[2], supported.x, supported.z);
    level(c[1], c[3], supported.y, supported.w);
}

void main() {
    if (work_group() >= tiles.count) return;
    uint id = tile_ids[work_group()];
    uvec3 count = uvec3(count_tiles);
    ivec3 tile = ivec3(id % count.x, id / count.x % count.y, id / (count.x * count.y));
    ivec3 block = BLOCK_TILE * tile + 2 * ivec3(gl_LocalInvocationID) - offset_vox;
    if (any(greaterThanEqual(block, size_vox))) return;

    // The rule runs in a frame mirrored and transposed by hash, so that no direction is favoured: a and b are the
    // block's horizontal axes. Cell k lies at corner + (k & 1) a + (k >> 1 & 1) b + (k >> 2) up.
    uint h = hash3(tick_key, uint(block.x + 1) | uint(block.z + 1) << 16, uint(block.y + 1));
    ivec2 mirror = ivec2(h & 1u, h >> 1 & 1u);
    ivec3 corner = block + ivec3(mirror.x, 0, mirror.y);
    ivec3 along_x = ivec3(1 - 2 * mirror.x, 0, 0);
    ivec3 along_z = ivec3(0, 0, 1 - 2 * mirror.y);
    bool transposed = (h & 4u) != 0u;
    ivec3 a = transposed ? along_z : along_x;
    ivec3 b = transposed ? along_x : along_z;

    int before[8];
    int c[8];
    bool has_water = false;
    bool has_sand = false;
    for (int k = 0; k < 8; ++k) {
        ivec3 cell = corner + (k & 1) * a + (k >> 1 & 1) * b + ivec3(0, k >> 2, 0);
        bool inside = all(lessThan(uvec3(cell), uvec3(size_vox)));
        before[k] = inside ? content_of(imageLoad(cells, cell).r) : CLOSED;
        c[k] = before[k];
        has_water = has_water || (c[k] > 0 && c[k] <= FULL);
        has_sand = has_sand || c[k] == SAND;
    }
    if (!has_water && !has_sand) return;

    for (int k = 0; k < 4; ++k) fall(c[k + 4], c[k]);

    if (has_sand) {
        slide(c[4], c[0], c[5], c[1]);
        slide(c[5], c[1], c[4], c[0]);
        slide(c[6], c[2], c[7], c[3]);
        slide(c[7], c[3], c[6], c[2]);
        slide(c[4], c[0], c[6], c[2]);
        slide(c[6], c[2], c[4], c[0]);
        slide(c[5], c[1], c[7], c[3]);
        slide(c[7], c[3], c[5], c[1]);
        // Diagonally at half of all places, for good, so that piles are round; never between two closed columns.
        uint ways = hash3(seed, uint(block.x + 1), uint(block.z + 1));
        int way = mirror.x ^ mirror.y;
        if ((ways >> way & 1u) != 0u && (is_open(c[5]) || is_open(c[6]))) {
            slide(c[4], c[0], c[7], c[3]);
            slide(c[7], c[3], c[4], c[0]);
        }
        if ((ways >> (1 - way) & 1u) != 0u && (is_open(c[4]) || is_open(c[7]))) {
            slide(c[5], c[1], c[6], c[2]);
            slide(c[6], c[2], c[5], c[1]);
        }
    }

    if (has_water) {
        bool as_one = (h >> 3 & 3u) == 0u;
        int lower[4] = int[4](c[0], c[1], c[2], c[3]);
        // What the lower layer rests on is not seen here, but for the world's floor.
        if (block.y == 0) level_layer(lower, bvec4(true), as_one);
        int upper[4] = int[4](c[4], c[5], c[6], c[7]);
        level_layer(upper, bvec4(supports(lower[0]), supports(lower[1]), supports(lower[2]), supports(lower[3])),
                    as_one);
        c = int[8](lower[0], lower[1], lower[2], lower[3], upper[0], upper[1], upper[2], upper[3]);
    }

    for (int k = 0; k < 8; ++k) {
        if (c[k] == before[k]) continue;
        ivec3 cell = corner + (k & 1) * a + (k >> 1 & 1) * b + ivec3(0, k >> 2, 0);
        imageStore(cells, cell, uvec4(cell_of(c[k])));
        mark_changed(cell);
    }
}
