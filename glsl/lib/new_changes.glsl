// What a reader of the log of changes finds new: the bricks to look at. src/passes/changes.h owns the buffer.
#include "lib/changes.glsl"
#include "lib/work_list.glsl"

layout(std430, binding = STORAGE_NEW_CHANGES) coherent buffer NewChanges {
    WorkHeader new_changes;
    uint new_changes_first;      // in the log
    uint new_changes_all;        // 1: more than the log holds, so every brick of the world counts as changed
    uint new_changes_read;       // change_count of the last reading
    uint new_changes_version;    // of the world in the last reading that found something
};

bool is_new_change(uint item) { return item < new_changes.count; }

uint new_change(uint item) {
    return new_changes_all != 0u ? item : changes[(new_changes_first + item) & change_mask];
}

uint new_change_item() { return work_group() * CHANGES_PER_GROUP + gl_LocalInvocationIndex; }
