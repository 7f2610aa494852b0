// One axis of the Chebyshev distance between bricks, a separable minimum: along the first axis the distance to a
// brick that holds something, along the others min over j of max(|i - j|, distance of j). An invocation a brick.
#include "shared/bindings.h"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;

layout(binding = BINDING_FIRST_INPUT) uniform usampler3D source;  // FIRST: occupancy; else the axis before
layout(rg8ui, binding = 0) writeonly uniform uimage3D target;

uniform ivec3 size_bricks;

uvec2 at(ivec3 brick) {
    uvec2 value = texelFetch(source, brick, 0).rg;
#if FIRST
    return uvec2(BRICK_DISTANCE_MAX) * (uvec2(1u) - value);
#else
    return value;
#endif
}

void main() {
    ivec3 brick = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(brick, size_bricks))) return;
    int i = brick[AXIS];
    int n = size_bricks[AXIS];
    uvec2 best = at(brick);
    // Beyond the world there is no water (g), and nothing that a ray could meet (r).
    best.g = min(best.g, uint(min(i + 1, n - i)));
    for (int d = 1; d < int(max(best.r, best.g)); ++d) {
        for (int side = -1; side <= 1; side += 2) {
            int j = i + side * d;
            if (j < 0 || j >= n) continue;
            ivec3 other = brick;
            other[AXIS] = j;
            best = min(best, max(uvec2(d), at(other)));
        }
    }
    imageStore(target, brick, uvec4(best, 0u, 0u));
}
