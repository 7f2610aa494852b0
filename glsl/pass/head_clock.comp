// What the head field does each time it runs, Settings::pressure_sweeps times a step: nothing while all sleeps, else
// one sweep, before which what was found in the last ones acts, once a round over the axes found nothing new. One
// invocation.
#include "shared/bindings.h"
#include "shared/water.h"
#include "lib/work_list.glsl"
#include "lib/head_clock.glsl"

layout(local_size_x = 1) in;

layout(std430, binding = STORAGE_ACTIVE_NEXT) readonly buffer ActiveNext { WorkHeader active_next; };

uniform ivec3 size_vox;

uint groups_for(int items) { return uint((items + HEAD_GROUP_SIDE - 1) / HEAD_GROUP_SIDE); }

void main() {
    sweep_groups = uint[3](0u, 0u, 0u);
    publish_groups = uint[3](0u, 0u, 0u);
    if (active_next.count == 0u) return;
    if (sweeps > 0u) quiet_sweeps = found != 0u ? 0u : quiet_sweeps + 1u;
    if (quiet_sweeps >= 3u || sweeps >= uint(HEAD_SWEEPS_MAX)) {
        sweeps = 0u;
        quiet_sweeps = 0u;
        publish_groups = uint[3](groups_for(size_vox.x), groups_for(size_vox.y), uint(size_vox.z));
    }
    int axis = axis_of_sweep(sweeps);
    sweep_groups = uint[3](groups_for(size_vox[(axis + 1) % 3]), groups_for(size_vox[(axis + 2) % 3]), 1u);
    found = 0u;
    ++sweeps;
}
