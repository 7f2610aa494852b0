// The log of bricks whose cells changed: each at most once for every version of the world, in any order. Written
// through lib/activity.glsl; a reader keeps to itself how far it has read. src/passes/changes.h owns the buffer.
#include "shared/bindings.h"

layout(std430, binding = STORAGE_CHANGES) coherent buffer ChangeLog {
    uint change_count;  // ever, modulo 2^32
    uint change_mask;   // how many the log still holds, a power of two, less one
    uint changes[];
};

void append_change(uint brick) { changes[atomicAdd(change_count, 1u) & change_mask] = brick; }
