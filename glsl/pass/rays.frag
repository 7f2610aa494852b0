// Rays of a list: the distance to what each meets (-1: nothing), its steps and the cells it reads, as a path's rays are
// traced; for the benchmark (src/bench/ray_kernel.cpp). Options: those of lib/traversal.glsl; RAYS_FROM_EYE finds cell
// and medium of the start.
#include "lib/traversal.glsl"

// One above the other, for every pixel: origin (vox); direction; cell, and in w the medium.
layout(rgba32f, binding = IMAGE_BENCH_RAYS) readonly restrict uniform image2D rays;
uniform int rows;

layout(location = 0) out vec4 out_found;  // distance, steps, cells read

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 origin = imageLoad(rays, at);
    vec3 dir = imageLoad(rays, at + ivec2(0, rows)).xyz;
    out_found = vec4(-1.0, 0.0, 0.0, 0.0);
    if (dir == vec3(0.0)) return;  // no ray
    float t_entry = 0.0;
#ifdef RAYS_FROM_EYE
    RayStart start;
    if (!enter_world(origin.xyz, dir, start, t_entry)) return;
#else
    ivec4 cell = ivec4(imageLoad(rays, at + ivec2(0, 2 * rows)));
    RayStart start = RayStart(origin.xyz, cell.xyz, uint(cell.w));
#endif
    RayHit hit = trace_ray(start, dir, TRAVERSAL_T_MAX);
    out_found = vec4(hit.kind == HIT_NONE ? -1.0 : t_entry + hit.t, vec2(hit.steps, hit.looks), 0.0);
}
