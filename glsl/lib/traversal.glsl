// Rays through the grid of cells: where the medium around a ray changes. Owns the walk and its samplers; knows
// nothing of optics. src/reference/traversal.cpp is the same walk, voxel by voxel, on the CPU.
// Options: TRAVERSAL_SKIP jumps over bricks of one medium; TRAVERSAL_THROUGH_WATER counts water as air.
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
    int axis;    // of the face: 0, 1, 2; 1 for a surface
    uint beyond;       // medium behind
    uint byte_beyond;  // of `cell`; 0 outside
    int steps;         // iterations, for cost views
};

// Components of a direction below this count as zero: over 1e7 voxels they move a ray by 1e-23.
const float TRAVERSAL_STILL = 1e-30;
// Stands for "never" where a direction has no component along an axis; beyond every limit.
const float TRAVERSAL_NEVER = 3e38;
const float TRAVERSAL_T_MAX = 1e30;

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

// True for water that leaves air above it in its voxel.
bool is_partly_filled(uint value) { return is_water(value) && value != MATERIAL_WATER_FULL; }

// Height of the water surface in a partly filled voxel; exact.
float surface_height(ivec3 cell, uint value) { return float(cell.y) + float(quanta_of(value)) * 0.0625; }

// The first change of medium along `dir` (unit length), at most t_max_vox from the origin.
// Amanatides & Woo 1987; t comes from integer planes, never from a sum; ties go x < y < z.
RayHit trace_ray(RayStart start, vec3 dir, float t_max_vox) {
    ivec3 size = frame.world_size_vox.xyz;
    float limit = min(t_max_vox, TRAVERSAL_T_MAX);
    bvec3 still = lessThan(abs(dir), vec3(TRAVERSAL_STILL));
    // (plane + NEVER) * 1 = NEVER on an axis without motion.
    precise vec3 origin = mix(start.origin_vox, vec3(-TRAVERSAL_NEVER), still);
    precise vec3 inv_dir = 1.0 / mix(dir, vec3(1.0), still);
    bvec3 forward = greaterThanEqual(dir, vec3(TRAVERSAL_STILL));
    ivec3 stride = mix(ivec3(-1), ivec3(1), forward);

    ivec3 cell = start.cell;
    uint medium = start.medium;
#ifdef TRAVERSAL_THROUGH_WATER
    if (medium == MATERIAL_WATER) medium = MATERIAL_AIR;
#endif
    uint value = inside_world(cell) ? cell_byte(cell) : MATERIAL_AIR;
    int clear_bricks = 0;
    int bound = size.x + size.y + size.z + 4;

    RayHit hit = RayHit(HIT_NONE, t_max_vox, cell, cell, 0, MATERIAL_AIR, 0u, 0);
    for (int i = 1; i <= bound; ++i) {
        hit.steps = i;
        ivec3 low = cell;
        ivec3 high = cell + 1;
#ifdef TRAVERSAL_SKIP
        if (clear_bricks > 0) {
            ivec3 brick = cell / BRICK_SIDE;
            low = max((brick + 1 - clear_bricks) * BRICK_SIDE, ivec3(0));
            high = min((brick + clear_bricks) * BRICK_SIDE, size);
        }
#endif
        precise vec3 t = (vec3(mix(low, high, forward)) - origin) * inv_dir;
        int axis = t.x <= t.y && t.x <= t.z ? 0 : t.y <= t.z ? 1 : 2;
        precise float t_exit = t[axis];

        if (is_partly_filled(value) && !still.y && forward.y == (medium == MATERIAL_WATER)) {
            precise float t_surface = (surface_height(cell, value) - origin.y) * inv_dir.y;
            if (t_surface <= t_exit) {
                if (t_surface <= limit) {
                    uint beyond = medium == MATERIAL_WATER ? MATERIAL_AIR : MATERIAL_WATER;
                    hit = RayHit(HIT_SURFACE, t_surface > 0.0 ? t_surface : 0.0, cell, cell, 1, beyond, value, i);
                }
                break;
            }
        }
        if (!(t_exit <= limit)) break;

#ifdef TRAVERSAL_SKIP
        if (clear_bricks > 0) {
            // The cell where single steps would be: every plane passed before the exit, ties by axis.
            ivec3 guess = ivec3(floor(start.origin_vox + t_exit * dir));
            guess = clamp(guess, mix(low, cell, forward), mix(cell, high - 1, forward));
            precise vec3 t_ahead = (vec3(guess + ivec3(forward)) - origin) * inv_dir;
            precise vec3 t_behind = (vec3(guess + 1 - ivec3(forward)) - origin) * inv_dir;
            for (int k = 0; k < 3; ++k) {
                bool ahead = t_ahead[k] < t_exit || (t_ahead[k] == t_exit && k < axis);
                bool behind = t_behind[k] < t_exit || (t_behind[k] == t_exit && k < axis);
                if (ahead) guess[k] += stride[k];
                else if (!behind && guess[k] != cell[k]) guess[k] -= stride[k];
            }
            guess[axis] = forward[axis] ? high[axis] - 1 : low[axis];
            cell = guess;
        }
#endif
        cell[axis] += stride[axis];
        bool within = inside_world(cell);
        value = within ? cell_byte(cell) : MATERIAL_AIR;
        uint beyond = material_of(value);
        if (is_partly_filled(value)) {
            float height = surface_height(cell, value);
            precise float t_surface = (height - origin.y) * inv_dir.y;
            bool below = still.y ? start.origin_vox.y < height : (t_exit < t_surface) == forward.y;
            beyond = below ? MATERIAL_WATER : MATERIAL_AIR;
        }
        if (beyond != medium) {
            ivec3 previous = cell;
            previous[axis] -= stride[axis];
            hit = RayHit(HIT_FACE, t_exit > 0.0 ? t_exit : 0.0, previous, cell, axis, beyond, value, i);
            break;
        }
        // A ray that enters starts one outside; any other that is outside has left.
        if (!within) break;
#ifdef TRAVERSAL_SKIP
        uvec2 distances = texelFetch(brick_distance, cell / BRICK_SIDE, 0).rg;
        clear_bricks = medium == MATERIAL_AIR ? int(distances.r) : medium == MATERIAL_WATER ? int(distances.g) : 0;
#endif
    }
    return hit;
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
