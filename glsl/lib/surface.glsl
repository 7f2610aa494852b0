// The surface that a pixel shows, in 32 bits: the material, the direction of its face, whether it is water that moves,
// and where its plane lies. All first hits lie on faces of voxels or on levels of water, so normals are axes, planes lie
// at whole sixteenths of a voxel, and the code is exact. The point is where the pixel's ray meets the plane.
#include "shared/materials.h"
#include "shared/trace.h"

// The code of the sky, whose normal is 0 (as it is where the eye is inside a solid).
const uint SURFACE_CODE_SKY = SURFACE_SKY;

// Bits 0 to 7 are the material, 8 to 10 the face: 0 for none, else 1 + 2 axis + 1 if it looks up that axis. Of water
// whose brick changed lately:
const uint SURFACE_MOVES = 0x800u;
const int SURFACE_PLANE_SHIFT = 12;
const uint SURFACE_KIND = (1u << SURFACE_PLANE_SHIFT) - 1u;  // all of it but where its plane lies
const float SURFACE_PLANES_PER_VOX = 16.0;

// normal: an axis, or 0 where there is no face.
uint surface_code(vec3 position_vox, vec3 normal, uint material) {
    if (normal == vec3(0.0)) return material;
    uint face = 1u + uint(2.0 * abs(normal.y) + 4.0 * abs(normal.z)) + (normal.x + normal.y + normal.z > 0.0 ? 1u : 0u);
    uint plane = uint(round(dot(position_vox, abs(normal)) * SURFACE_PLANES_PER_VOX));
    return material | face << 8 | plane << SURFACE_PLANE_SHIFT;
}

bool is_moving(uint code) { return (code & SURFACE_MOVES) != 0u; }

uint surface_material(uint code) { return code & 255u; }

// The axis that the face looks along; 0 where there is none.
vec3 surface_axis(uint code) {
    uint face = (code >> 8) & 7u;
    uint axis = (face - 1u) >> 1;
    return vec3(axis == 0u, axis == 1u, axis == 2u);
}

vec3 surface_normal(uint code) { return ((code >> 8) & 1u) == 0u ? surface_axis(code) : -surface_axis(code); }

// Of its plane along its axis.
float surface_plane_vox(uint code) { return float(code >> SURFACE_PLANE_SHIFT) / SURFACE_PLANES_PER_VOX; }

// Stands for the distance of the sky; farther than any world may lie.
const float SURFACE_FAR_VOX = 1e8;

// How far along the ray its plane lies; not finite or below 0 where the ray does not meet it.
float distance_to_plane(uint code, vec3 eye_vox, vec3 dir) {
    vec3 axis = surface_axis(code);
    return (surface_plane_vox(code) - dot(eye_vox, axis)) / dot(dir, axis);
}

// Where the ray of the pixel meets it, or would if it went on.
vec3 surface_point(uint code, vec3 eye_vox, vec3 dir) {
    float along = code == SURFACE_CODE_SKY ? SURFACE_FAR_VOX : distance_to_plane(code, eye_vox, dir);
    return eye_vox + (along > 0.0 ? min(along, SURFACE_FAR_VOX) : 0.0) * dir;  // 0 where it is not a number, too
}

// Between two planes along one axis, in sixteenths of a voxel.
int planes_apart(uint a, uint b) { return abs(int(a >> SURFACE_PLANE_SHIFT) - int(b >> SURFACE_PLANE_SHIFT)); }

bool on_parallel_planes(uint a, uint b) { return ((a ^ b) & SURFACE_KIND) == 0u; }

// Levels of neighbouring voxels of water differ by sixteenths and move by them, and are shaded as one surface: planes
// within half a voxel.
const int WATER_PLANES = 8;
// Moving water changes its faces faster than light can be gathered: all of them count as one surface, but for parallel
// ones farther apart than this. Passes that look farther than the next pixel test how far the points are, too.
const float MOVING_TOLERANCE_VOX = 4.0;
const int MOVING_PLANES = int(MOVING_TOLERANCE_VOX * SURFACE_PLANES_PER_VOX);

// Whether `there` lies on the plane and the material of `here`; the sky is one surface.
bool lies_on(uint here, uint there) {
    bool both_move = is_moving(here & there);
    int tolerance = both_move ? MOVING_PLANES : surface_material(here) == MATERIAL_WATER ? WATER_PLANES : 0;
    bool parallel = on_parallel_planes(here | SURFACE_MOVES, there | SURFACE_MOVES);
    return parallel ? planes_apart(here, there) <= tolerance : both_move;
}
