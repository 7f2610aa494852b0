// The surface that a pixel shows, in one texel: xyz is its point (vox), w a code of its material, of the face's
// direction and of whether it is water that moves, a small whole number. All first hits lie on faces or levels, so
// normals are axes.
#include "shared/materials.h"
#include "shared/trace.h"

// Of the sky, whose normal is 0.
const float SURFACE_CODE_SKY = float(SURFACE_SKY);

// normal: an axis, or 0 for the sky.
float surface_code(vec3 normal, uint material) {
    vec3 along = abs(normal);
    float face = 2.0 * along.y + 4.0 * along.z + (normal.x + normal.y + normal.z > 0.0 ? 2.0 : 1.0);
    return float(material) + (normal == vec3(0.0) ? 0.0 : 256.0 * face);
}

// Added to the code of water whose brick changed lately.
const float SURFACE_MOVES = 2048.0;

bool is_moving(float code) { return code >= SURFACE_MOVES; }

uint surface_material(float code) { return uint(code) & 255u; }

vec3 surface_normal(float code) {
    uint face = (uint(code) >> 8) & 7u;
    if (face == 0u) return vec3(0.0);
    float side = (face & 1u) == 0u ? 1.0 : -1.0;
    uint axis = (face - 1u) >> 1;
    return side * vec3(axis == 0u, axis == 1u, axis == 2u);
}

// Distance from the plane of a first hit (vox) within which two hits are on one surface, plus its growth with the
// distance from the eye (float32 rounding of positions).
const float PLANE_TOLERANCE_VOX = 0.01;
const float PLANE_TOLERANCE_PER_VOX = 1e-5;

// Levels of neighbouring voxels of water differ by sixteenths and move by them, and are shaded as one surface.
const float WATER_TOLERANCE_VOX = 0.5;

float plane_tolerance(vec4 surface, vec3 eye_vox) {
    float least = surface_material(surface.w) == MATERIAL_WATER ? WATER_TOLERANCE_VOX : PLANE_TOLERANCE_VOX;
    return least + PLANE_TOLERANCE_PER_VOX * distance(surface.xyz, eye_vox);
}

// Moving water changes its faces faster than light can be gathered: within this distance (vox) along each axis it counts
// as one surface.
const float MOVING_TOLERANCE_VOX = 4.0;

// Whether `there` lies on the plane and the material of `here`, whose normal is n; the sky is one surface.
bool lies_on(vec4 here, vec4 there, vec3 n, float tolerance) {
    if (is_moving(here.w) && is_moving(there.w))
        return all(lessThan(abs(there.xyz - here.xyz), vec3(MOVING_TOLERANCE_VOX)));
    float apart = abs(here.w - there.w);
    return (apart == 0.0 || apart == SURFACE_MOVES) && (here.w == SURFACE_CODE_SKY || abs(dot(there.xyz - here.xyz, n)) <= tolerance);
}
