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

const uint RNG_ORDERS = 15u;  // bits of a shift that say in which order its number takes the steps

// Uniform in [0,1): the top 24 bits, so that 1.0 is never reached by rounding. In a sequence the n-th path adds n steps
// to a shift of its own for every number, within sixteen in an order of its own too: numbers of one path then depend on
// each other no more than independent ones.
float rng_in_sequence(uint shift, uint step_size) {
    uint order = shift & RNG_ORDERS;
    uint value = shift + ((rng_place ^ order) - order) * step_size;
    return float(value >> 8) * (1.0 / 16777216.0);
}

// Steps in 2^-32, for pairs in both. Those of the golden ratio and of Roberts' R2 (2018) spread the paths of consecutive
// frames as well, but every fourth of them, which a shown pixel gets where one in 2x2 is traced, no better than chance or
// worse; these were searched for both, and for every ninth. `balanced` over all recordings .0456 -> .0429.
const uint RNG_STEP = 2773093120u;
const uvec2 RNG_STEP_OF_PAIRS = uvec2(3314273635u, 1515164811u);

float rng_float() { return rng_in_sequence(rng_next(), RNG_STEP); }

// The same number for 4x2 pixels in a sequence: lanes of a SIMD machine that end together save time.
float rng_shared(int which) {
    return rng_group == 0u ? rng_float() : rng_in_sequence(hash1(rng_group + uint(which)), RNG_STEP);
}

vec2 rng_vec2() {
    uint a = rng_next();
    // One order for both, or they would not spread over the square.
    uint b = (rng_next() & ~RNG_ORDERS) | (a & RNG_ORDERS);
    return vec2(rng_in_sequence(a, RNG_STEP_OF_PAIRS.x), rng_in_sequence(b, RNG_STEP_OF_PAIRS.y));
}
