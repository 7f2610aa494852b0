// What the bricks that changed hold: r 1 where a cell is not air, g 1 where a cell is not full water (or lies
// beyond the world). An invocation a brick. Where an answer changed, the distances are dispatched anew.
#include "shared/materials.h"
#include "shared/bindings.h"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;

layout(binding = BINDING_CELLS) uniform usampler3D cells;
layout(r32ui, binding = 0) readonly uniform uimage3D brick_changed;
layout(rg8ui, binding = 1) uniform uimage3D occupancy;

// Indirect arguments of brick_distance.comp: 0 groups until something changed.
layout(std430, binding = 0) writeonly buffer DistanceGroups { uint groups[3]; };
// The version at which any cell last changed.
layout(std430, binding = 1) writeonly buffer LastChange { uint last_change; };

uniform ivec3 size_bricks;
uniform uvec3 distance_groups;
uniform uint version;

void main() {
    ivec3 brick = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(brick, size_bricks))) return;
    if (imageLoad(brick_changed, brick).r != version) return;
    last_change = version;

    ivec3 first = brick * BRICK_SIDE;
    bool cut = any(greaterThan(first + BRICK_SIDE, textureSize(cells, 0)));
    ivec3 size = min(textureSize(cells, 0) - first, ivec3(BRICK_SIDE));
    uvec2 holds = uvec2(0u, cut ? 1u : 0u);
    int count = size.x * size.y * size.z;
    for (int i = 0; i < count && holds != uvec2(1u); ++i) {
        uint cell = texelFetch(cells, first + ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y)), 0).r;
        if (cell != MATERIAL_AIR) holds.r = 1u;
        if (cell != MATERIAL_WATER_FULL) holds.g = 1u;
    }
    if (imageLoad(occupancy, brick).rg == holds) return;
    imageStore(occupancy, brick, uvec4(holds, 0u, 0u));
    groups[0] = distance_groups.x;
    groups[1] = distance_groups.y;
    groups[2] = distance_groups.z;
}
