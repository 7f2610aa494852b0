// One ray of the eye: the voxel around it, or else the first surface it meets. A single invocation.
#include "lib/traversal.glsl"

layout(local_size_x = 1) in;

uniform vec3 ray_dir;  // unit

layout(std430, binding = 0) buffer PickBlock {
    ivec4 cell;    // xyz; w: 1 where something is hit
    ivec4 normal;  // xyz; w: byte of the cell
} pick;

void main() {
    RayStart start;
    float t_entry;
    pick.cell = ivec4(0);
    pick.normal = ivec4(0);
    if (!enter_world(frame.camera_position_vox.xyz, ray_dir, start, t_entry)) return;
    if (start.medium != MATERIAL_AIR) {
        // The eye sits in the voxel: no face lies before it.
        pick.cell = ivec4(start.cell, 1);
        pick.normal = ivec4(ivec3(0), int(cell_byte(start.cell)));
        return;
    }
    RayHit hit = trace_ray(start, ray_dir, frame.trace_limits.x);
    if (hit.kind == HIT_NONE) return;
    ivec3 normal = ivec3(0);
    normal[hit.axis] = ray_dir[hit.axis] > 0.0 ? -1 : 1;
    pick.cell = ivec4(hit.cell, inside_world(hit.cell) ? 1 : 0);
    pick.normal = ivec4(normal, int(hit.byte_beyond));
}
