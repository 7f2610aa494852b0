// Rays of a list: the distance to what each meets (-1: nothing) and its steps, as a path's rays are traced; for the
// benchmark (src/bench/ray_kernel.cpp). Options: those of lib/traversal.glsl; RAYS_FROM_EYE finds cell and medium of
// the start.
#include "lib/traversal.glsl"

struct Ray {
    vec4 origin_vox;
    vec4 dir;
    ivec4 cell;  // w: medium
};
layout(std430, binding = 0) readonly buffer Rays { Ray rays[]; };
uniform int count;
uniform int tiles_per_row;

layout(location = 0) out vec2 out_distance_steps;

void main() {
    // Eight rays in a row go to 4x2 pixels.
    ivec2 at = ivec2(gl_FragCoord.xy);
    int index = 8 * (at.x / 4 + tiles_per_row * (at.y / 2)) + at.x % 4 + 4 * (at.y % 2);
    out_distance_steps = vec2(-1.0, 0.0);
    if (index >= count) return;
    vec3 dir = rays[index].dir.xyz;
    RayStart start = RayStart(rays[index].origin_vox.xyz, rays[index].cell.xyz, uint(rays[index].cell.w));
    float t_entry = 0.0;
#ifdef RAYS_FROM_EYE
    if (!enter_world(rays[index].origin_vox.xyz, dir, start, t_entry)) return;
#endif
    RayHit hit = trace_ray(start, dir, TRAVERSAL_T_MAX);
    out_distance_steps = vec2(hit.kind == HIT_NONE ? -1.0 : t_entry + hit.t, float(hit.steps));
}
