// Where the occupancy of bricks changed, and so where each axis of the distances is computed anew.
// src/passes/bricks.h owns the buffers.
#include "shared/bindings.h"

// The box around all that changed; low > high: nothing did.
layout(std430, binding = STORAGE_BRICK_FLIPS) coherent buffer BrickFlips {
    int flips_low[4];
    int flips_high[4];
};

struct DistanceBox {
    ivec4 low, high;      // bricks, both included
    uint groups[4];       // of brick_distance.comp, by indirect dispatch
};
// By axis.
layout(std430, binding = STORAGE_DISTANCE_BOXES) buffer DistanceBoxes { DistanceBox distance_boxes[3]; };

// Sides of a workgroup, in lines of bricks
const int LINES_SIDE = 8;
