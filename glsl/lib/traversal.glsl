// Rays through the grid of cells: where the medium around a ray changes. Owns the walk and its samplers; knows
// nothing of optics. src/reference/traversal.cpp is the same walk, voxel by voxel, on the CPU.
// Options: TRAVERSAL_SKIP jumps over bricks of one medium; TRAVERSAL_THROUGH_WATER counts water as air;
// TRACE_COUNT adds up iterations.
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/materials.h"

layout(binding = BINDING_CELLS) uniform usampler3D cells;
#ifdef TRAVERSAL_SKIP
layout(binding = BINDING_BRICK_DISTANCE) uniform usampler3D brick_distance;
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
};

// Components of a direction below this count as zero: over 1e7 voxels they move a ray by 1e-23.
const float TRAVERSAL_STILL = 1e-30;
// Stands for "never" where a direction has no component along an axis; beyond every limit.
const float TRAVERSAL_NEVER = 3e38;
const float TRAVERSAL_T_MAX = 1e30;

#ifdef TRACE_COUNT
int steps_walked = 0;  // of all rays so far
#endif

uint cell_byte(ivec3 cell) {
    uint value = texelFetch(cells, cell, 0).r;
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

// Height of the water surface in a partly filled voxel; exact.
float surface_height(ivec3 cell, uint value) { return float(cell.y) + float(quanta_of(value)) * 0.0625; }

// The first change of medium along `dir` (unit length), at most t_max_vox from the origin.
// Amanatides & Woo 1987; t comes from integer planes, never from a sum; ties go x < y < z. Lanes of a SIMD machine
// pay for the whole body in every iteration, so it carries little state and the hit is put together behind it.
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
    uint value = inside_world(cell) ? cell_byte(cell) : MATERIAL_AIR;
    precise float t_surface = (surface_height(cell, value) - start.origin_vox.y) * surface_inv;
    if (!heads_for_surface || !is_partly_filled(value)) t_surface = TRAVERSAL_NEVER;

#ifdef TRAVERSAL_SKIP
    int clear_bricks = 0;  // distance to the nearest brick that holds anything but this medium
    uint air_mask = medium == MATERIAL_AIR ? 0xffu : 0u;
    uint water_mask = medium == MATERIAL_WATER ? 0xffu : 0u;
    // Far more than o + t * d errs by, far less than a voxel.
    vec3 behind = vec3(stride) * 0.015625;
#endif
    float t_exit = 0.0;
    int axis = 0;
    uint beyond = medium;
    int bound = size.x + size.y + size.z + 4;
    int steps = 0;
    while (steps < bound) {
        ++steps;
        // The far faces of the voxel, or of the box of clear bricks around it.
        ivec3 plane = cell + forward;
#ifdef TRAVERSAL_SKIP
        ivec3 far_plane = ((cell / BRICK_SIDE) + 1 - forward + clear_bricks * stride) * BRICK_SIDE;
        plane = mix(plane, clamp(far_plane, ivec3(0), size), bvec3(clear_bricks > 0));
#endif
        precise vec3 t = (vec3(plane) - origin) * inv_dir;
        bool x_first = t.x <= t.y && t.x <= t.z;
        bool z_first = !x_first && !(t.y <= t.z);
        axis = x_first ? 0 : z_first ? 2 : 1;
        t_exit = x_first ? t.x : z_first ? t.z : t.y;
        if (t_surface <= t_exit || !(t_exit <= limit)) break;

        ivec3 next = cell;
#ifdef TRAVERSAL_SKIP
        // On the other axes the voxel where single steps would be: the guess is right or one behind, and moves on
        // if the ray passed its far plane before the exit, ties by axis. For a box of one voxel it is that voxel.
        ivec3 guess = ivec3(start.origin_vox + t_exit * dir - behind);
        next = clamp(guess, min(cell, plane), max(cell, plane - 1));
        precise vec3 t_next = (vec3(next + forward) - origin) * inv_dir;
        bvec3 passed = bvec3(x_first ? t_next.x < t_exit : t_next.x <= t_exit,
                             z_first ? t_next.y <= t_exit : t_next.y < t_exit, t_next.z < t_exit);
        next += stride * ivec3(passed);
#endif
        cell = mix(next, plane - 1 + forward, bvec3(x_first, !x_first && !z_first, z_first));

        bool within = inside_world(cell);
        value = within ? cell_byte(cell) : MATERIAL_AIR;
        bool partly = is_partly_filled(value);
        precise float t_level = (surface_height(cell, value) - start.origin_vox.y) * surface_inv;
        bool below = (t_exit < t_level) == rising;
        beyond = partly ? (below ? MATERIAL_WATER : MATERIAL_AIR) : material_of(value);
        // A ray that enters starts one outside; any other that is outside has left.
        if (beyond != medium || !within) break;
        t_surface = partly && heads_for_surface ? t_level : TRAVERSAL_NEVER;
#ifdef TRAVERSAL_SKIP
        uvec2 distances = texelFetch(brick_distance, cell / BRICK_SIDE, 0).rg;
        clear_bricks = int((distances.r & air_mask) | (distances.g & water_mask));
#endif
    }

#ifdef TRACE_COUNT
    if (limit >= 0.0) steps_walked += steps;  // below 0 the ray was not asked for
#endif

    if (beyond != medium) {
        ivec3 previous = cell;
        previous[axis] -= stride[axis];
        return RayHit(HIT_FACE, t_exit > 0.0 ? t_exit : 0.0, previous, cell, axis, beyond, value, steps);
    }
    if (t_surface <= t_exit && t_surface <= limit) {
        beyond = medium == MATERIAL_WATER ? MATERIAL_AIR : MATERIAL_WATER;
        return RayHit(HIT_SURFACE, t_surface > 0.0 ? t_surface : 0.0, cell, cell, 1, beyond, value, steps);
    }
    return RayHit(HIT_NONE, t_max_vox, start.cell, start.cell, 0, MATERIAL_AIR, 0u, steps);
}

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
