// The boxes in which distances change: an axis carries a change as far as the largest distance, the axes run in the
// order y, x, z. One invocation.
#include "lib/distance_boxes.glsl"

layout(local_size_x = 1) in;

uniform ivec3 size_bricks;

void main() {
    ivec3 low = ivec3(flips_low[0], flips_low[1], flips_low[2]);
    ivec3 high = ivec3(flips_high[0], flips_high[1], flips_high[2]);
    bool any_flipped = low.x <= high.x;
    for (int i = 0; i < 3; ++i) {
        int axis = i == 0 ? 1 : i == 1 ? 0 : 2;
        low[axis] = max(low[axis] - (BRICK_DISTANCE_MAX - 1), 0);
        high[axis] = min(high[axis] + (BRICK_DISTANCE_MAX - 1), size_bricks[axis] - 1);
        ivec3 groups = (high - low + LINES_SIDE) / LINES_SIDE;
        distance_boxes[axis].low = ivec4(low, 0);
        distance_boxes[axis].high = ivec4(high, 0);
        distance_boxes[axis].groups[0] = any_flipped ? uint(axis == 0 ? groups.y : groups.x) : 0u;
        distance_boxes[axis].groups[1] = any_flipped ? uint(axis == 2 ? groups.y : groups.z) : 0u;
        distance_boxes[axis].groups[2] = 1u;
    }
    for (int k = 0; k < 3; ++k) {
        flips_low[k] = 0x7fffffff;
        flips_high[k] = -1;
    }
}
