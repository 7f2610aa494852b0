// glsl/lib/rng.glsl under test: floats of chosen and of many states, seeds that hash to zero.
#include "lib/rng.glsl"

layout(local_size_x = 64) in;

uniform uint count;

layout(std430, binding = 0) buffer ResultBlock {
    float largest_possible;  // of an output of all ones
    uint at_one;             // floats >= 1 among the samples
    uint stuck;              // states that became 0
    uint histogram[16];
} result;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i == 0u) {
        // The state before an all-ones output: xorshift is a bijection, undone step by step.
        uint x = 0xffffffffu;
        x ^= x << 5; x ^= x << 10; x ^= x << 20;
        x ^= x >> 17;
        x ^= x << 13; x ^= x << 26;
        rng_state = x;
        uint check = rng_next();
        rng_state = x;
        result.largest_possible = check == 0xffffffffu ? rng_float() : -1.0;
    }
    if (i >= count) return;
    rng_seed(uvec2(i & 1023u, i >> 10), i * 7u, i & 3u, i == 5u ? 0u : 1u);
    if (rng_state == 0u) atomicAdd(result.stuck, 1u);
    for (int k = 0; k < 16; ++k) {
        float u = rng_float();
        if (u >= 1.0 || u < 0.0) atomicAdd(result.at_one, 1u);
        atomicAdd(result.histogram[uint(u * 16.0)], 1u);
    }
}
