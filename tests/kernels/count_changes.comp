// Counts how often each brick is set aside as changed.
#include "lib/new_changes.glsl"

layout(local_size_x = CHANGES_PER_GROUP) in;

layout(std430, binding = 0) buffer Seen { uint seen[]; };

void main() {
    uint item = new_change_item();
    if (is_new_change(item)) atomicAdd(seen[new_change(item)], 1u);
}
