// Light that a surface returns under a white sky: means of the sampled weights over a lattice of random numbers.
#include "tests/kernels/bsdf_case.glsl"

layout(local_size_x = 64) in;

// x: reflected; y: transmitted, without the scaling of radiance by the index; z: largest weight; w: not finite.
layout(std430, binding = 0) buffer SumBlock { vec4 sums[]; };

void main() {
    Surface s = case_surface();
    vec4 sum = vec4(0.0);
    for (int k = 0; k < count; ++k) {
        // Roberts 2018, R3: powers of the root of x^4 = x + 1, times 2^32.
        uvec3 step = uvec3(3518319155u, 2882110345u, 2360945575u);
        uint n = gl_GlobalInvocationID.x * uint(count) + uint(k);
        vec3 u = vec3((n * step + 0x80000000u) >> 8) / 16777216.0;
        BsdfSample sampled = case_sample(s, wo, u);
        float weight = sampled.weight.x;
        bool transmitted = sampled.wi.z < 0.0;
        if (transmitted) weight *= eta * eta;
        if (!is_finite(weight)) {
            sum.w += 1.0;
            continue;
        }
        sum += vec4(transmitted ? 0.0 : weight, transmitted ? weight : 0.0, 0.0, 0.0);
        sum.z = max(sum.z, weight);
    }
    sums[gl_GlobalInvocationID.x] = sum;
}
