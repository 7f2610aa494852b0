// Random numbers of a path: xorshift32 (Marsaglia 2003), seeded by a hash of pixel, frame and sample; or, for the paths
// of a pixel that are averaged, numbers that spread evenly over them.
#include "shared/hash.h"

uint rng_state = 1u;
uint rng_place = 0u;  // in the sequence; 0: independent numbers
uint rng_group = 0u;  // the shift of what a group of pixels shares

void rng_seed(uvec2 pixel, uint frame_index, uint sample_index, uint seed) {
    rng_state = hash4(pixel.x | (pixel.y << 16), frame_index, sample_index, seed);
    // 0 is the one state that xorshift cannot leave.
    if (rng_state == 0u) rng_state = 0x9e3779b9u;
    rng_place = 0u;
    rng_group = 0u;
}

// Paths of a pixel in one sequence. Each sequence is shifted anew, so that no path is biased.
const uint RNG_SEQUENCE = 64u;

void rng_seed_sequence(uvec2 pixel, uint path_index, uint seed) {
    rng_seed(pixel, path_index / RNG_SEQUENCE, 0xffffffffu, seed);
    rng_place = path_index % RNG_SEQUENCE;
    rng_group = hash4((pixel.x >> 2) | ((pixel.y >> 1) << 16), path_index / RNG_SEQUENCE, 0xfffffffeu, seed);
}

uint rng_next() {
    rng_state ^= rng_state << 13;
    rng_state ^= rng_state >> 17;
    rng_state ^= rng_state << 5;
    return rng_state;
}

// Uniform in [0,1): the top 24 bits, so that 1.0 is never reached by rounding. In a sequence the n-th path adds n steps
// to a shift of its own for every number, within sixteen in an order of its own too: numbers of one path then depend on
// each other no more than independent ones.
float rng_in_sequence(uint shift, uint step_size) {
    uint order = shift & 15u;
    uint value = shift + ((rng_place ^ order) - order) * step_size;
    return float(value >> 8) * (1.0 / 16777216.0);
}
float rng_unit(uint step_size) { return rng_in_sequence(rng_next(), step_size); }

// Steps in 2^-32: the golden ratio's; for pairs those of Roberts' sequence R2 (2018).
float rng_float() { return rng_unit(2654435769u); }

// The same number for 4x2 pixels in a sequence: lanes of a SIMD machine that end together save time.
float rng_shared(int which) {
    return rng_group == 0u ? rng_float() : rng_in_sequence(hash1(rng_group + uint(which)), 2654435769u);
}

vec2 rng_vec2() {
    float x = rng_unit(3242174889u);
    return vec2(x, rng_unit(2447445414u));
}
