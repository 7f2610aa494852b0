// Sampled directions counted by bins; paths that end are counted with the rest.
#include "tests/kernels/bsdf_case.glsl"
#include "tests/kernels/direction_bins.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer CountBlock { uint counts[BIN_REST + 1]; };

// Jarzynski & Olano 2020, pcg3d: better numbers than the shaders' own, so that the surface alone is tested.
uvec3 hash(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v += v.yzx * v.zxy;
    v ^= v >> 16;
    return v + v.yzx * v.zxy;
}

void main() {
    Surface s = case_surface();
    for (int k = 0; k < count; ++k) {
        vec3 u = vec3(hash(uvec3(gl_GlobalInvocationID.x, uint(k), seed)) >> 8) / 16777216.0;
        BsdfSample sampled = case_sample(s, wo, u);
        bool ends = max_component(sampled.weight) <= 0.0;
        atomicAdd(counts[ends ? BIN_REST : bin_of(wo, sampled.wi)], 1u);
    }
}
