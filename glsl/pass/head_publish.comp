// The head that was found becomes the one that acts, and the search begins anew; bricks wake in which it changed by
// more than a quarter voxel where it presses. An invocation a cell.
#include "lib/activity.glsl"
#include "lib/water.glsl"
#include "lib/head.glsl"

layout(local_size_x = HEAD_GROUP_SIDE, local_size_y = HEAD_GROUP_SIDE) in;

layout(r32ui, binding = IMAGE_ACTING_HEAD) uniform uimage3D acting_head;
layout(r32ui, binding = IMAGE_BUILDING_HEAD) uniform uimage3D building_head;

uniform ivec3 size_vox;

int pressing_height(uint head) { return is_confined(head) ? height_of(head) : 0; }

void main() {
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, size_vox))) return;
    uint acting = imageLoad(acting_head, cell).r;
    uint built = imageLoad(building_head, cell).r;
    if (abs(pressing_height(built) - pressing_height(acting)) > 1) mark_brick_active(cell / BRICK_SIDE);
    if (built != acting) imageStore(acting_head, cell, uvec4(built));
    if (built != 0u) imageStore(building_head, cell, uvec4(0u));
}
