// Telling that a cell changed: stamps its brick for the picture and for the sleep of the water, logs it for the
// structures that hang on the cells, and puts a brick that was asleep on the list of active ones.
// src/passes/activity.h owns the buffers. A tick here is a step: Settings::water_substeps of them make a tick of the
// world.
#include "shared/bindings.h"
#include "shared/water.h"
#include "lib/changes.glsl"
#include "lib/matter.glsl"
#include "lib/work_list.glsl"

layout(r32ui, binding = IMAGE_BRICK_CHANGED) coherent uniform uimage3D brick_changed;

// The tick in which a cell of each brick last changed.
layout(std430, binding = STORAGE_CHANGED_TICK) coherent buffer ChangedTick { uint changed_tick[]; };
// Bricks with a change in the last SLEEP_TICKS ticks, for the tick to come.
layout(std430, binding = STORAGE_ACTIVE_NEXT) coherent buffer ActiveNext {
    WorkHeader active_next;
    uint active_next_bricks[];
};

uniform ivec3 size_bricks;
uniform uint tick;
uniform uint version;

void append_active(uint brick) {
    uint slot = atomicAdd(active_next.count, 1u);
    active_next_bricks[slot] = brick;
    if (slot % ACTIVE_PER_GROUP == 0u) {
        uint group = slot / ACTIVE_PER_GROUP;
        atomicMax(active_next.groups_x, min(group + 1u, WORK_GROUPS_PER_ROW));
        if (group % WORK_GROUPS_PER_ROW == 0u) atomicAdd(active_next.groups_y, 1u);
    }
}

void mark_active(uint brick) {
    // A loop that runs at most once: llvmpipe runs the body of a branch for lanes that do not take it.
    for (bool unmarked = changed_tick[brick] != tick; unmarked; unmarked = false) {
        uint before = atomicExchange(changed_tick[brick], tick);
        // A brick that has been unchanged for longer is on no list.
        for (bool asleep = tick - before > uint(SLEEP_TICKS); asleep; asleep = false) append_active(brick);
    }
}

uint index_of_brick(ivec3 brick) { return uint(brick.x + size_bricks.x * (brick.y + size_bricks.y * brick.z)); }

void mark_brick_active(ivec3 brick) { mark_active(index_of_brick(brick)); }

void mark_brick_changed(ivec3 brick) {
    for (bool unstamped = imageLoad(brick_changed, brick).r != version; unstamped; unstamped = false)
        for (bool first = imageAtomicExchange(brick_changed, brick, version) != version; first; first = false) {
            append_change(index_of_brick(brick));
            int word = matter_word(brick, size_bricks);
            atomicOr(matter[word].moves, 1u << (brick.x & 31));
            atomicOr(matter[word].room, 1u << (brick.x & 31));
        }
    mark_brick_active(brick);
}

void mark_changed(ivec3 cell) { mark_brick_changed(cell / BRICK_SIDE); }
