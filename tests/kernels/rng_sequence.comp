// glsl/lib/rng.glsl under test: the numbers of a pixel's paths in a sequence. An invocation a pixel.
#include "lib/rng.glsl"

layout(local_size_x = 64) in;

uniform uint count;
uniform uint looked_at;  // a path, of which the histogram is made

layout(std430, binding = 0) buffer ResultBlock {
    uint histogram[16];  // of one path's number, over the pixels
    uint products;       // of that number and the next, in 1024ths, rounded down
    uint least, most;    // of a pixel's paths in a sixteenth of [0,1)
    uint least_pairs[2], most_pairs[2];  // of 16 of its paths in a quarter of the square: consecutive; every fourth
} result;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint bins[16] = uint[16](0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    uint quarters[8] = uint[8](0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    for (uint path = 0u; path < RNG_SEQUENCE; ++path) {
        rng_seed_sequence(uvec2(i & 255u, i >> 8), 3u * RNG_SEQUENCE + path, 5u);
        uvec2 half_of = uvec2(rng_vec2() * 2.0);
        uint quarter = half_of.x + 2u * half_of.y;
        if (path / 16u == 1u) ++quarters[quarter];
        if (path % 4u == 1u) ++quarters[4u + quarter];
        float u = rng_float();
        ++bins[uint(u * 16.0)];
        if (path != looked_at) continue;
        atomicAdd(result.histogram[uint(u * 16.0)], 1u);
        atomicAdd(result.products, uint(u * rng_float() * 1024.0));
    }
    for (int bin = 0; bin < 16; ++bin) {
        atomicMin(result.least, bins[bin]);
        atomicMax(result.most, bins[bin]);
    }
    for (int k = 0; k < 8; ++k) {
        atomicMin(result.least_pairs[k >> 2], quarters[k]);
        atomicMax(result.most_pairs[k >> 2], quarters[k]);
    }
}
