// Which bricks may hold what moves, water or sand, and which room to move in: anything but solids and full water.
// Both are set with every change and made exact once a version. src/passes/activity.h owns the buffer.
#include "shared/bindings.h"

// Of 32 bricks along x.
struct MatterWord {
    uint moves, room;
};
layout(std430, binding = STORAGE_MATTER) coherent buffer Matter { MatterWord matter[]; };

int matter_word(ivec3 brick, ivec3 size_bricks) {
    return (brick.x >> 5) + ((size_bricks.x + 31) >> 5) * (brick.y + size_bricks.y * brick.z);
}
