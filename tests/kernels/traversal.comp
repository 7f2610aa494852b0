// Runs trace_ray or enter_world of lib/traversal.glsl over a buffer of rays; used by gpu/traversal_test.cpp.
layout(local_size_x = 64) in;
#include "lib/traversal.glsl"

struct Ray {
    vec4 origin_vox;  // w: the limit
    vec4 dir;
    ivec4 cell;  // w: medium
};
struct Result {
    vec4 point;         // of the hit; w: t
    ivec4 hit;          // kind, axis, beyond, byte
    ivec4 cell;         // w: iterations
    ivec4 previous;     // w: 1 when enter_world found the world
    vec4 start_origin;  // w: t_entry
    ivec4 start_cell;   // w: medium
};
layout(std430, binding = 0) readonly buffer Rays {
    Ray rays[];
};
layout(std430, binding = 1) writeonly buffer Results {
    Result results[];
};
uniform int count;
uniform bool from_eye;  // starts with enter_world, ignoring cell and medium

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= count) return;
    vec3 dir = rays[index].dir.xyz;
    RayStart start = RayStart(rays[index].origin_vox.xyz, rays[index].cell.xyz, uint(rays[index].cell.w));
    float t_entry = 0.0;
    bool entered = !from_eye || enter_world(rays[index].origin_vox.xyz, dir, start, t_entry);
    Result result = Result(vec4(0.0), ivec4(0), ivec4(0), ivec4(0), vec4(0.0), ivec4(0));
    if (entered) {
        RayHit hit = trace_ray(start, dir, rays[index].origin_vox.w);
        result.point = vec4(hit.kind == HIT_NONE ? start.origin_vox : hit_point(start, dir, hit), hit.t);
        result.hit = ivec4(hit.kind, hit.axis, hit.beyond, hit.byte_beyond);
        result.cell = ivec4(hit.cell, hit.steps);
        result.previous = ivec4(hit.previous, 1);
        result.start_origin = vec4(start.origin_vox, t_entry);
        result.start_cell = ivec4(start.cell, start.medium);
    }
    results[index] = result;
}
