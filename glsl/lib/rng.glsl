// Random numbers of a path: xorshift32 (Marsaglia 2003), seeded by a hash of pixel, frame and sample.
#include "shared/hash.h"

uint rng_state = 1u;

void rng_seed(uvec2 pixel, uint frame_index, uint sample_index, uint seed) {
    rng_state = hash4(pixel.x | (pixel.y << 16), frame_index, sample_index, seed);
    // 0 is the one state that xorshift cannot leave.
    if (rng_state == 0u) rng_state = 0x9e3779b9u;
}

uint rng_next() {
    rng_state ^= rng_state << 13;
    rng_state ^= rng_state >> 17;
    rng_state ^= rng_state << 5;
    return rng_state;
}

// Uniform in [0,1): the top 24 bits, so that 1.0 is never reached by rounding.
float rng_float() { return float(rng_next() >> 8) * (1.0 / 16777216.0); }

vec2 rng_vec2() {
    float x = rng_float();
    return vec2(x, rng_float());
}
