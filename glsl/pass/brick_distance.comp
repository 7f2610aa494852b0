// One axis of the Chebyshev distance between bricks, a separable minimum: along the first axis the distance to a
// brick that holds something, along the others min over j of max(|i - j|, distance of j). An invocation a line of the
// axis' box, up and down it once: every distance follows from the one before.
#include "lib/distance_boxes.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = BINDING_FIRST_INPUT) uniform usampler3D source;  // FIRST: occupancy; else the axis before
layout(rg8ui, binding = 0) coherent uniform uimage3D target;

uniform ivec3 size_bricks;

const int NEVER = -0x10000;

// The distances r and g of what lies behind, as a sweep passes: `least` is the minimum at this brick, `at` the latest
// brick whose own distance is at most that, `latest` the latest brick of each distance, of g behind r.
const int LATEST_OF_G = BRICK_DISTANCE_MAX + 1;
struct Sweep {
    ivec2 least, at;
    int latest[2 * LATEST_OF_G];
};
Sweep sweep;

ivec2 own_distance(ivec3 brick) {
    ivec2 value = ivec2(texelFetch(source, brick, 0).rg);
#if FIRST
    return BRICK_DISTANCE_MAX * (1 - value);
#else
    return value;
#endif
}

void begin() {
    sweep.least = ivec2(BRICK_DISTANCE_MAX);
    sweep.at = ivec2(NEVER);
    for (int d = 0; d < 2 * LATEST_OF_G; ++d) sweep.latest[d] = NEVER;
}

// To brick number `k` of the sweep, of distance `own`.
void advance(int k, ivec2 own) {
    // Too far from all of that distance: the next one reaches, from no further back.
    bvec2 farther = greaterThan(ivec2(k) - sweep.at, sweep.least);
    sweep.least = min(sweep.least + ivec2(farther), ivec2(BRICK_DISTANCE_MAX));
    sweep.at.r = max(sweep.at.r, sweep.latest[sweep.least.r]);
    sweep.at.g = max(sweep.at.g, sweep.latest[LATEST_OF_G + sweep.least.g]);
    bvec2 nearer = lessThanEqual(own, sweep.least);
    sweep.least = mix(sweep.least, own, nearer);
    sweep.at = mix(sweep.at, ivec2(k), nearer);
    sweep.latest[own.r] = k;
    sweep.latest[LATEST_OF_G + own.g] = k;
}

void main() {
    const int u = AXIS == 0 ? 1 : 0;
    const int v = AXIS == 2 ? 1 : 2;
    ivec3 low = distance_boxes[AXIS].low.xyz;
    ivec3 high = distance_boxes[AXIS].high.xyz;
    ivec3 brick = low;
    brick[u] += int(gl_GlobalInvocationID.x);
    brick[v] += int(gl_GlobalInvocationID.y);
    if (brick[u] > high[u] || brick[v] > high[v]) return;
    int first = low[AXIS];
    int last = high[AXIS];
    int n = size_bricks[AXIS];
    const int reach = BRICK_DISTANCE_MAX - 1;

    for (int way = 0; way < 2; ++way) {
        begin();
        // What lies before the box reaches into it.
        int start = way == 0 ? max(first - reach, 0) : min(last + reach, n - 1);
        int count = way == 0 ? last - start + 1 : start - first + 1;
        for (int k = 0; k < count; ++k) {
            int i = way == 0 ? start + k : start - k;
            brick[AXIS] = i;
            advance(k, own_distance(brick));
            if (i < first || i > last) continue;
            ivec2 least = sweep.least;
            if (way == 1) least = min(least, ivec2(imageLoad(target, brick).rg));
            // Beyond the world there is no water (g), and nothing that a ray could meet (r).
            least.g = min(least.g, min(i + 1, n - i));
            imageStore(target, brick, uvec4(uvec2(least), 0u, 0u));
        }
    }
}
