// Every face, plane and material: counts what surface_code does not give back, and pairs that lies_on takes wrongly
// (reuse_test.cpp). x: the plane in sixteenths of a voxel; y: axis and side; z: the material.
#include "lib/surface.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Result { uint cases, wrong_code, wrong_point, wrong_still, wrong_moving; };

bool takes(uint here, vec3 point, vec3 normal, uint material, int planes_on, uint marks) {
    return lies_on(here | marks, surface_code(point + abs(normal) * float(planes_on) / 16.0, normal, material) | marks);
}

void main() {
    uint side = gl_GlobalInvocationID.y;
    uint material = gl_GlobalInvocationID.z;
    vec3 axis = vec3(side >> 1 == 0u, side >> 1 == 1u, side >> 1 == 2u);
    vec3 normal = (side & 1u) == 0u ? axis : -axis;
    float plane = float(gl_GlobalInvocationID.x) / 16.0;
    vec3 point = mix(vec3(3.3, 517.9, 40.1), vec3(plane), axis);
    uint code = surface_code(point, normal, material);
    atomicAdd(cases, 1u);

    bool same = surface_material(code) == material && surface_normal(code) == normal && surface_axis(code) == axis;
    same = same && surface_plane_vox(code) == plane && !is_moving(code) && is_moving(code | SURFACE_MOVES);
    if (!same || surface_plane_vox(code | SURFACE_MOVES) != plane) atomicAdd(wrong_code, 1u);

    vec3 eye = point + 7.0 * normal + vec3(2.0, 3.0, -1.0) * (1.0 - axis);
    vec3 found = surface_point(code, eye, normalize(point - eye));
    if (distance(found, point) > 1e-3) atomicAdd(wrong_point, 1u);

    // Water to half a voxel, all else to its plane; nothing of another material or direction.
    bool water = material == MATERIAL_WATER;
    bool right = takes(code, point, normal, material, 0, 0u) && takes(code, point, normal, material, 8, 0u) == water;
    right = right && takes(code, point, normal, material, 1, 0u) == water;
    right = right && !takes(code, point, normal, material, 9, 0u) && !takes(code, point, normal, material ^ 1u, 0, 0u);
    right = right && !takes(code, point, -normal, material, 0, 0u) && !takes(code, point, normal.yzx, material, 0, 0u);
    right = right && !lies_on(code, SURFACE_CODE_SKY) && lies_on(SURFACE_CODE_SKY, SURFACE_CODE_SKY);
    if (!right) atomicAdd(wrong_still, 1u);

    // What moves to four voxels, and in any other direction.
    bool moves = takes(code, point, normal, material, 64, SURFACE_MOVES);
    moves = moves && !takes(code, point, normal, material, 65, SURFACE_MOVES);
    if (!moves || !takes(code, point, normal.yzx, material, 0, SURFACE_MOVES)) atomicAdd(wrong_moving, 1u);
}
