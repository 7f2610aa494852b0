// Sets aside what was logged since a reader's last reading. One invocation.
#include "lib/new_changes.glsl"

layout(local_size_x = 1) in;

uniform uint bricks;   // of the world
uniform bool restart;  // everything counts as new
uniform uint version;

void main() {
    uint count = change_count - new_changes_read;
    bool all = restart || count > change_mask + 1u;
    new_changes_first = new_changes_read;
    new_changes_read = change_count;
    new_changes_all = all ? 1u : 0u;
    if (all) count = bricks;
    uint groups = (count + CHANGES_PER_GROUP - 1u) / CHANGES_PER_GROUP;
    new_changes = WorkHeader(min(groups, WORK_GROUPS_PER_ROW),
                             (groups + WORK_GROUPS_PER_ROW - 1u) / WORK_GROUPS_PER_ROW, 1u, count);
    if (count > 0u) new_changes_version = version;
}
