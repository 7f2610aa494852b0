// Marks a list of bricks as changed and wakes them: what was edited between two steps. An invocation a brick.
#include "lib/activity.glsl"

layout(local_size_x = ACTIVE_PER_GROUP) in;

layout(std430, binding = STORAGE_ACTIVE) readonly buffer Touched { uint touched_bricks[]; };

uniform uint count;

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(ACTIVE_PER_GROUP);
    if (item >= count) return;
    uint id = touched_bricks[item];
    uvec3 size = uvec3(size_bricks);
    mark_brick_changed(ivec3(id % size.x, id / size.x % size.y, id / (size.x * size.y)));
}
