// Which bricks may hold what moves: water or sand. Set with every change, made exact once a version; bricks where
// springs flow in count always. src/passes/activity.h owns the buffer.
#include "shared/bindings.h"

// Of 32 bricks along x: what they hold, and whether they count always.
layout(std430, binding = STORAGE_MATTER) coherent buffer Matter { uvec2 matter_bits[]; };

int matter_word(ivec3 brick, ivec3 size_bricks) {
    return (brick.x >> 5) + ((size_bricks.x + 31) >> 5) * (brick.y + size_bricks.y * brick.z);
}
