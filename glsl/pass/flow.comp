// A spring or a drain over its region: an invocation a cell. What is made or taken is counted in 64 bits.
#include "shared/materials.h"
#include "lib/activity.glsl"

layout(local_size_x = 8, local_size_y = 4, local_size_z = 8) in;

layout(r8ui, binding = IMAGE_CELLS) uniform uimage3D cells;

// Pairs (low, high): water sprung, water drained (quanta), sand sprung, sand drained (voxels).
layout(std430, binding = 0) buffer FlowCounters { uint counters[8]; };

uniform ivec3 region_min_vox;  // the region lies inside the world
uniform ivec3 region_size_vox;

#ifdef SPRING
uniform bool makes_sand;
uniform uint base;  // of SpringShare in src/world/schedule.h
uniform uvec3 rest_stride_phase;
#endif

void count(int counter, uint amount) {
    uint old = atomicAdd(counters[2 * counter], amount);
    if (old + amount < old) atomicAdd(counters[2 * counter + 1], 1u);
}

void main() {
    ivec3 local = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(local, region_size_vox))) return;
    ivec3 cell = region_min_vox + local;
    uint before = imageLoad(cells, cell).r;
    uint after = before;
#ifdef SPRING
    uvec3 at = uvec3(local);
    uvec3 size = uvec3(region_size_vox);
    uint i = at.x + size.x * (at.y + size.y * at.z);
    uint n = size.x * size.y * size.z;
    uint due = base + ((i * rest_stride_phase.y + rest_stride_phase.z) % n < rest_stride_phase.x ? 1u : 0u);
    if (makes_sand) {
        if (before == MATERIAL_AIR && due > 0u) after = MATERIAL_SAND;
        if (after != before) count(2, 1u);
    } else if (before == MATERIAL_AIR || is_water(before)) {
        uint made = min(due, QUANTA_PER_VOXEL - quanta_of(before));
        after = water_cell(quanta_of(before) + made);
        if (made > 0u) count(0, made);
    }
#else
    if (is_water(before)) count(1, quanta_of(before));
    if (before == MATERIAL_SAND) count(3, 1u);
    if (is_water(before) || before == MATERIAL_SAND) after = MATERIAL_AIR;
#endif
    if (after == before) return;
    imageStore(cells, cell, uvec4(after));
    mark_changed(cell);
}
