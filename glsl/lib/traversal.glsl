// Rays through the grid of cells: where the medium around a ray changes. Owns the walk and its samplers; knows
// nothing of optics. src/reference/traversal.cpp is the same walk, voxel by voxel, on the CPU.
// Options: TRAVERSAL_SKIP jumps over what is clear (shared/rooms.h); TRAVERSAL_THROUGH_WATER counts water as air;
// TRACE_COUNT adds up iterations.
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/materials.h"
#include "shared/rooms.h"

// Images, which give 0 beyond their ends: llvmpipe reads a texel of them in a third of the instructions of texelFetch,
// which looks for its mip level first.
layout(r8ui, binding = IMAGE_CELLS) readonly restrict uniform uimage3D cells;
#ifdef TRAVERSAL_SKIP
layout(rg32ui, binding = IMAGE_BRICK_ROOMS) readonly restrict uniform uimage3D brick_rooms;
#endif

// Where a ray starts. `cell` may lie one outside the world (a ray that enters); `medium` is the material id around
// the origin: MATERIAL_AIR, MATERIAL_WATER, or the byte of anything else.
struct RayStart {
    vec3 origin_vox;
    ivec3 cell;
    uint medium;
};

const int HIT_NONE = 0;     // left the world in air, or beyond the limit
const int HIT_FACE = 1;     // the medium changes at the face between `previous` and `cell`
const int HIT_SURFACE = 2;  // the medium changes at the water surface inside `cell`; previous == cell

struct RayHit {
    int kind;
    float t;  // voxels from the origin; the limit where nothing is hit
    ivec3 previous;
    ivec3 cell;  // may lie one outside the world
    int axis;          // of the face: 0, 1, 2; 1 for a surface
    uint beyond;       // medium behind
    uint byte_beyond;  // of `cell`; 0 outside
    int steps;         // iterations, for cost views
    int looks;         // cells read
};

// Components of a direction below this count as zero: over 1e7 voxels they move a ray by 1e-23.
const float TRAVERSAL_STILL = 1e-30;
// Stands for "never" where a direction has no component along an axis; beyond every limit.
const float TRAVERSAL_NEVER = 3e38;
const float TRAVERSAL_T_MAX = 1e30;

#ifdef TRACE_COUNT
int steps_walked = 0;  // of all rays so far
#endif

// Air beyond the world.
uint cell_byte(ivec3 cell) {
    uint value = imageLoad(cells, cell).r;
#ifdef TRAVERSAL_THROUGH_WATER
    return is_water(value) ? MATERIAL_AIR : value;
#else
    return value;
#endif
}

bool inside_world(ivec3 cell) {
    return all(lessThan(uvec3(cell), uvec3(frame.world_size_vox.xyz)));
}

uint byte_or_air(ivec3 cell) { return inside_world(cell) ? cell_byte(cell) : MATERIAL_AIR; }

// True for water that leaves air above it in its voxel.
bool is_partly_filled(uint value) { return is_water(value) && value != MATERIAL_WATER_FULL; }

bool is_air_to_water(uint a, uint b) {
    return (a == MATERIAL_AIR && b == MATERIAL_WATER) || (a == MATERIAL_WATER && b == MATERIAL_AIR);
}

// Height of the water surface in a partly filled voxel; exact.
float surface_height(ivec3 cell, uint value) { return float(cell.y) + float(quanta_of(value)) * 0.0625; }

// The first change of medium along `dir` (unit length), at most t_max_vox from the origin.
// Amanatides & Woo 1987; t comes from integer planes, never from a sum; ties go x < y < z. Lanes of a SIMD machine
// pay for the whole body in every iteration, so it carries little state and the hit is put together behind it.
#ifdef TRAVERSAL_SKIP
// How far a step may go: to the far faces of the voxel, the 2x2x2 block, the brick or the room around it.
struct Step {
    int low;        // cell | low: the last cell of that voxel, block or brick
    ivec3 reach;    // from there to the far faces
    bool may_meet;  // the voxel may be of another medium
};

// Of the voxel at `cell`, by the word of its brick; room_shift: of the octant's level.
Step step_of(uvec2 word, ivec3 cell, int room_shift) {
    // Bit x + 4 y of a half of the brick; z's lowest bit adds 16.
    int at = (cell.x & 3) | ((cell.y & 3) << 2) | ((cell.z & 1) << 4);
    uint half_mask = (cell.z & 2) != 0 ? word.y : word.x;
    uint block = half_mask >> (at & 10);
    bool is_clear = word.y == ROOM_CLEAR && word.x < ROOM_LEVELS_END;
    int level = is_clear ? int((word.x >> room_shift) & 7u) : 0;
    int across = BRICK_SIDE << min(level, 4);  // of room_across
    Step next;
    next.low = is_clear ? BRICK_SIDE - 1 : (block & 0x330033u) == 0u ? 1 : 0;
    // Of room_up: to the brick above the quarter.
    int up = (((1 << level) + 3) >> 2) << BRICK_SHIFT;
    next.reach = ivec3(across, up, across) - (BRICK_SIDE - 1);  // 1 in a brick that is not clear
    next.may_meet = !is_clear && ((block >> (at & 21)) & 1u) != 0u;
    return next;
}

RayHit trace_ray(RayStart start, vec3 dir, float t_max_vox) {
    float limit = min(t_max_vox, TRAVERSAL_T_MAX);
    bvec3 still = lessThan(abs(dir), vec3(TRAVERSAL_STILL));
    // The walk's own grid: mirrored (c to ~c) along axes on which the ray falls, so that there it only rises.
    ivec3 mirror = -ivec3(lessThanEqual(dir, vec3(-TRAVERSAL_STILL)));
    vec3 sense = vec3(1 + 2 * mirror);
    // (plane + NEVER) * 1 = NEVER on an axis without motion.
    precise vec3 origin = mix(start.origin_vox * sense, vec3(-TRAVERSAL_NEVER), still);
    precise vec3 inv_dir = 1.0 / mix(abs(dir), vec3(1.0), still);
    ivec3 at = start.cell ^ mirror;
    // Behind the ray by far more than o + t * d errs by, by far less than a voxel.
    vec3 guess_origin = mix(start.origin_vox * sense - 0.015625, vec3(at) + 0.5, still);
    vec3 guess_dir = mix(abs(dir), vec3(0.0), still);
    ivec3 size = frame.world_size_vox.xyz;
    ivec3 end = mix(size, ivec3(0), bvec3(mirror));
    int room_shift = 21 + 3 * (mirror.x + 2 * mirror.y + 4 * mirror.z);

    uint medium = start.medium;
#ifdef TRAVERSAL_THROUGH_WATER
    if (medium == MATERIAL_WATER) medium = MATERIAL_AIR;
#endif
    int layer = medium == MATERIAL_WATER ? (size.z + BRICK_SIDE - 1) >> BRICK_SHIFT : 0;
    // Nothing is known ahead of rays in any other medium.
    uint unknown = medium == MATERIAL_AIR || medium == MATERIAL_WATER ? 0u : 0xffffffffu;
    // A level ray counts as rising ever so slowly: below a surface exactly if its origin is.
    bool rising = dir.y > -TRAVERSAL_STILL;
    precise float surface_inv = still.y ? 1e35 : rising ? inv_dir.y : -inv_dir.y;
    bool heads_for_surface = !still.y && (medium == MATERIAL_WATER) == rising;

    ivec3 cell = start.cell;
    bool within = inside_world(cell);
    ivec3 layers = ivec3(0, 0, layer);
    Step next = step_of(imageLoad(brick_rooms, (cell >> BRICK_SHIFT) + layers).rg | unknown, cell, room_shift);
    if (!within) next = Step(0, ivec3(1), false);
    uint value = MATERIAL_AIR;
    uint beyond = medium;
    float t_exit = 0.0;
    int axis = 0;
    int bound = size.x + size.y + size.z + 4;
    int steps = 0;
    int looks = 0;
    precise float t_surface = TRAVERSAL_NEVER;
    bool on_surface = false;
    // Steps, then a look at the voxel that they end in; at once where the ray may meet a surface in its first.
    bool steps_on = !(next.may_meet && heads_for_surface);
    for (bool looks_on = true; looks_on;) {
        while (steps_on) {
            ++steps;
            ivec3 plane = (at | next.low) + next.reach;
            precise vec3 t = (vec3(plane) - origin) * inv_dir;
            t_exit = min(t.x, min(t.y, t.z));
            bool x_first = t.x <= t_exit;
            bool z_first = !x_first && t.y > t_exit;
            axis = x_first ? 0 : z_first ? 2 : 1;
            // The voxel where single steps would be: the guess is right or one behind, and moves on if the ray passed
            // its far plane before or, by the order of ties, with the exit.
            ivec3 guess = max(ivec3(floor(guess_origin + t_exit * guess_dir)), at);
            precise vec3 t_next = (vec3(guess + 1) - origin) * inv_dir;
            bvec3 passed = bvec3(t_next.x <= t_exit, x_first ? t_next.y < t_exit : t_next.y <= t_exit,
                                 z_first ? t_next.z <= t_exit : t_next.z < t_exit);
            at = guess + ivec3(passed);
            cell = at ^ mirror;
            next = step_of(imageLoad(brick_rooms, (cell >> BRICK_SHIFT) + layers).rg | unknown, cell, room_shift);
            within = all(lessThan(at, end));
            steps_on = within && !next.may_meet && t_exit <= limit && steps < bound;
        }
        bool over = !(t_exit <= limit) || steps >= bound;
        ++looks;
        value = cell_byte(cell);
        bool partly = is_partly_filled(value);
        t_surface = (surface_height(cell, value) - start.origin_vox.y) * surface_inv;
        bool below = (t_exit < t_surface) == rising;
        beyond = partly ? (below ? MATERIAL_WATER : MATERIAL_AIR) : material_of(value);
        if (over || steps == 0) beyond = medium;
        precise vec3 t = (vec3(at + 1) - origin) * inv_dir;
        on_surface = !over && partly && heads_for_surface && t_surface <= min(t.x, min(t.y, t.z));
        looks_on = !over && within && beyond == medium && !on_surface;
        steps_on = looks_on;
    }

#ifdef TRACE_COUNT
    if (limit >= 0.0) steps_walked += steps;  // below 0 the ray was not asked for
#endif

    bool on_face = beyond != medium;
    on_surface = on_surface && !on_face && t_surface <= limit;
    if (on_surface) beyond = medium == MATERIAL_WATER ? MATERIAL_AIR : MATERIAL_WATER;
    bool met = on_face || on_surface;
    float t_met = max(on_face ? t_exit : t_surface, 0.0);
    ivec3 previous = cell;
    if (on_face) previous -= (1 + 2 * mirror) * ivec3(axis == 0, axis == 1, axis == 2);
    return RayHit(on_face ? HIT_FACE : on_surface ? HIT_SURFACE : HIT_NONE, met ? t_met : t_max_vox,
                  met ? previous : start.cell, met ? cell : start.cell, on_face ? axis : on_surface ? 1 : 0,
                  met ? beyond : MATERIAL_AIR, met ? value : 0u, steps, looks);
}
#else
// The same, voxel by voxel.
RayHit trace_ray(RayStart start, vec3 dir, float t_max_vox) {
    ivec3 size = frame.world_size_vox.xyz;
    float limit = min(t_max_vox, TRAVERSAL_T_MAX);
    bvec3 still = lessThan(abs(dir), vec3(TRAVERSAL_STILL));
    // (plane + NEVER) * 1 = NEVER on an axis without motion.
    precise vec3 origin = mix(start.origin_vox, vec3(-TRAVERSAL_NEVER), still);
    precise vec3 inv_dir = 1.0 / mix(dir, vec3(1.0), still);
    ivec3 forward = ivec3(greaterThanEqual(dir, vec3(TRAVERSAL_STILL)));
    ivec3 stride = 2 * forward - 1;
    // A level ray counts as rising ever so slowly: below a surface exactly if its origin is.
    bool rising = dir.y > -TRAVERSAL_STILL;
    precise float surface_inv = still.y ? 1e35 : inv_dir.y;

    ivec3 cell = start.cell;
    uint medium = start.medium;
#ifdef TRAVERSAL_THROUGH_WATER
    if (medium == MATERIAL_WATER) medium = MATERIAL_AIR;
#endif
    // Whether the ray heads for a surface in a partly filled voxel, and when it meets that of this voxel.
    bool heads_for_surface = !still.y && (medium == MATERIAL_WATER) == rising;
    uint value = cell_byte(cell);
    precise float t_surface = (surface_height(cell, value) - start.origin_vox.y) * surface_inv;
    if (!heads_for_surface || !is_partly_filled(value)) t_surface = TRAVERSAL_NEVER;

    float t_exit = 0.0;
    int axis = 0;
    uint beyond = medium;
    int bound = size.x + size.y + size.z + 4;
    int steps = 0;
    while (steps < bound) {
        ++steps;
        ivec3 plane = cell + forward;
        precise vec3 t = (vec3(plane) - origin) * inv_dir;
        bool x_first = t.x <= t.y && t.x <= t.z;
        bool z_first = !x_first && !(t.y <= t.z);
        axis = x_first ? 0 : z_first ? 2 : 1;
        t_exit = x_first ? t.x : z_first ? t.z : t.y;
        if (t_surface <= t_exit || !(t_exit <= limit)) break;

        ivec3 next = cell;
        cell = mix(next, plane - 1 + forward, bvec3(x_first, !x_first && !z_first, z_first));

        bool within = inside_world(cell);
        value = cell_byte(cell);
        bool partly = is_partly_filled(value);
        precise float t_level = (surface_height(cell, value) - start.origin_vox.y) * surface_inv;
        bool below = (t_exit < t_level) == rising;
        beyond = partly ? (below ? MATERIAL_WATER : MATERIAL_AIR) : material_of(value);
        // A ray that enters starts one outside; any other that is outside has left.
        if (beyond != medium || !within) break;
        t_surface = partly && heads_for_surface ? t_level : TRAVERSAL_NEVER;
    }

#ifdef TRACE_COUNT
    if (limit >= 0.0) steps_walked += steps;  // below 0 the ray was not asked for
#endif

    if (beyond != medium) {
        ivec3 previous = cell;
        previous[axis] -= stride[axis];
        return RayHit(HIT_FACE, t_exit > 0.0 ? t_exit : 0.0, previous, cell, axis, beyond, value, steps, steps + 1);
    }
    if (t_surface <= t_exit && t_surface <= limit) {
        beyond = medium == MATERIAL_WATER ? MATERIAL_AIR : MATERIAL_WATER;
        return RayHit(HIT_SURFACE, t_surface > 0.0 ? t_surface : 0.0, cell, cell, 1, beyond, value, steps, steps + 1);
    }
    return RayHit(HIT_NONE, t_max_vox, start.cell, start.cell, 0, MATERIAL_AIR, 0u, steps, steps + 1);
}
#endif

// The start of a ray from the eye. Inside the world: its cell and medium, t_entry = 0. Outside (air): the point
// where it enters, t_entry voxels on, with the cell one outside there, so that the entry face is the first that
// the walk tests. False where the ray misses the world.
bool enter_world(vec3 origin, vec3 dir, out RayStart start, out float t_entry) {
    vec3 size = vec3(frame.world_size_vox.xyz);
    bvec3 still = lessThan(abs(dir), vec3(TRAVERSAL_STILL));
    bvec3 forward = greaterThanEqual(dir, vec3(TRAVERSAL_STILL));
    bvec3 back = lessThanEqual(dir, vec3(-TRAVERSAL_STILL));
    start = RayStart(origin, ivec3(0), MATERIAL_AIR);
    t_entry = 0.0;
    precise float t_near = -TRAVERSAL_NEVER;
    precise float t_far = TRAVERSAL_NEVER;
    int entry_axis = -1;
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
        bool within = (origin[k] > 0.0 || (origin[k] == 0.0 && !back[k])) &&
                      (origin[k] < size[k] || (origin[k] == size[k] && back[k]));
        inside = inside && within;
        if (still[k]) {
            if (!within) return false;
            continue;
        }
        precise float inv = 1.0 / dir[k];
        precise float t0 = ((forward[k] ? 0.0 : size[k]) - origin[k]) * inv;
        precise float t1 = ((forward[k] ? size[k] : 0.0) - origin[k]) * inv;
        // On a tie the last axis: walking in from afar it would be stepped last.
        if (t0 >= t_near) {
            t_near = t0;
            entry_axis = k;
        }
        if (t1 < t_far) t_far = t1;
    }
    if (!inside) {
        if (!(t_near >= 0.0 && t_near <= t_far && t_near <= TRAVERSAL_T_MAX)) return false;
        t_entry = t_near;
        precise vec3 point = origin + t_near * dir;
        start.origin_vox = clamp(point, vec3(0.0), size);
    }
    // On a plane with that component negative the ray is in the lower cell.
    ivec3 cell = ivec3(mix(floor(start.origin_vox), ceil(start.origin_vox) - 1.0, back));
    start.cell = clamp(cell, ivec3(0), frame.world_size_vox.xyz - 1);
    if (!inside) {
        start.origin_vox[entry_axis] = forward[entry_axis] ? 0.0 : size[entry_axis];
        start.cell[entry_axis] = forward[entry_axis] ? -1 : frame.world_size_vox[entry_axis];
        return true;
    }
    uint value = cell_byte(start.cell);
    start.medium = material_of(value);
    if (is_partly_filled(value) && !(origin.y < surface_height(start.cell, value))) start.medium = MATERIAL_AIR;
    return true;
}

// Where a hit lies: on its plane exactly, otherwise within the voxel that the ray was in.
vec3 hit_point(RayStart start, vec3 dir, RayHit hit) {
    precise vec3 point = start.origin_vox + hit.t * dir;
    point = clamp(point, vec3(hit.previous), vec3(hit.previous + 1));
    if (hit.kind == HIT_SURFACE) {
        point.y = surface_height(hit.cell, hit.byte_beyond);
    } else {
        point[hit.axis] = float(max(hit.previous[hit.axis], hit.cell[hit.axis]));
    }
    return point;
}
