// Lists of work made on the GPU: indirect arguments, how many there are, then the items. Groups are laid out in
// rows, as a driver promises no more than 65535 along an axis.
const uint WORK_GROUPS_PER_ROW = 32768u;

struct WorkHeader {
    uint groups_x, groups_y, groups_z, count;
};

uint work_group() { return gl_WorkGroupID.y * WORK_GROUPS_PER_ROW + gl_WorkGroupID.x; }
