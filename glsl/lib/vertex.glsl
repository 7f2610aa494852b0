// A surface point that scatters: its frame, its value and density towards a direction.
#include "shared/frame.h"
#include "shared/trace.h"
#include "lib/bsdf.glsl"
#include "lib/traversal.glsl"


// World axes to the local frame whose z is the axis of the normal, and back; side: the normal's sign.
vec3 to_local(vec3 v, int axis, float side) {
    vec3 p = axis == 0 ? v.yzx : axis == 1 ? v.zxy : v;
    return vec3(p.xy, p.z * side);
}
vec3 from_local(vec3 v, int axis, float side) {
    vec3 p = vec3(v.xy, v.z * side);
    return axis == 0 ? p.zxy : axis == 1 ? p.yzx : p;
}

vec3 axis_vector(int axis, float side) { return vec3(axis == 0 ? side : 0.0, axis == 1 ? side : 0.0, axis == 2 ? side : 0.0); }

float component(vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

float power_heuristic(float a, float b) {
    // In this form neither square overflows.
    if (a <= 0.0) return 0.0;
    float r = b / a;
    return 1.0 / (1.0 + r * r);
}

vec3 limited(vec3 light, int bounce) {
    float limit = frame.trace_limits.z;
    float m = max_component(light);
    return limit > 0.0 && bounce > 0 && m > limit ? light * (limit / m) : light;
}

// A surface point that scatters.
struct Vertex {
    RayStart start;  // of rays that leave it on this side
    int axis;        // of its normal
    float side;
    vec3 wo;         // local
    Surface surface;
#ifdef TRACE_SMOOTH_WATER
    mat3 tilt;       // from the frame of the shading normal to that of the axis
#endif
};

// Directions to the frame in which the vertex scatters, and back.
vec3 vertex_local(Vertex v, vec3 dir) {
#ifdef TRACE_SMOOTH_WATER
    return to_local(dir, v.axis, v.side) * v.tilt;
#else
    return to_local(dir, v.axis, v.side);
#endif
}
vec3 vertex_world(Vertex v, vec3 local) {
#ifdef TRACE_SMOOTH_WATER
    return from_local(v.tilt * local, v.axis, v.side);
#else
    return from_local(local, v.axis, v.side);
#endif
}

void vertex_eval(Vertex v, vec3 wi, out vec3 f_cos, out float pdf) {
#ifdef TRACE_ROUGH
    if (v.surface.transmissive)
        dielectric_eval(v.surface, v.wo, wi, f_cos, pdf);
    else
#endif
        opaque_eval(v.surface, v.wo, wi, option(OPTION_UNIFORM_DIFFUSE), f_cos, pdf);
}
