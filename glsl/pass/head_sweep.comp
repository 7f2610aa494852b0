// One sweep of the head along all lines of one axis of the world, both ways; the first of a search also takes in the
// free surfaces. An invocation a line.
#include "shared/bindings.h"
#include "shared/water.h"
#include "lib/water.glsl"
#include "lib/head.glsl"
#include "lib/head_clock.glsl"

layout(local_size_x = HEAD_GROUP_SIDE, local_size_y = HEAD_GROUP_SIDE) in;

layout(binding = BINDING_CELLS) uniform usampler3D cells;
layout(r32ui, binding = IMAGE_BUILDING_HEAD) uniform uimage3D building_head;

uniform ivec3 size_vox;
uniform int film_threshold;

int content_at(ivec3 cell) {
    return all(lessThan(uvec3(cell), uvec3(size_vox))) ? content_of(texelFetch(cells, cell, 0).r) : CLOSED;
}

// Above the world is sky.
int content_above(ivec3 cell) { return cell.y + 1 == size_vox.y ? 0 : content_at(cell + ivec3(0, 1, 0)); }

// A free surface feeds head if it stands and is not the edge of a bump.
bool feeds(ivec3 cell) {
    int above = content_above(cell);
    int below = content_at(cell - ivec3(0, 1, 0));
    if (above >= FULL / 2 || below < FULL / 2) return false;
    ivec4 beside = ivec4(content_at(cell + ivec3(1, 0, 0)), content_at(cell - ivec3(1, 0, 0)),
                         content_at(cell + ivec3(0, 0, 1)), content_at(cell - ivec3(0, 0, 1)));
    return all(greaterThanEqual(beside, ivec4(film_threshold)));
}

void main() {
    int axis = axis_of_sweep(sweeps - 1u);
    bool seeds = sweeps == 1u;
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    ivec3 cell = ivec3(0);
    cell[u] = int(gl_GlobalInvocationID.x);
    cell[v] = int(gl_GlobalInvocationID.y);
    if (cell[u] >= size_vox[u] || cell[v] >= size_vox[v]) return;
    int n = size_vox[axis];
    bool new_here = false;
    for (int way = 0; way < 2; ++way) {
        uint carried = 0u;
        for (int k = 0; k < n; ++k) {
            cell[axis] = way == 0 ? k : n - 1 - k;
            int content = content_of(texelFetch(cells, cell, 0).r);
            // Head passes through water that is half full, or a film under a ceiling.
            bool wet = content > 0 && is_open(content);
            bool ceiling = wet && !is_open(content_above(cell));
            if (!wet || (2 * content < FULL && !(ceiling && content >= film_threshold))) {
                carried = 0u;
                continue;
            }
            uint before = imageLoad(building_head, cell).r;
            uint head = before;
            if ((carried & HEAD_REACH) != 0u) {
                carried -= HEAD_STEP;
                if (ceiling) carried &= ~HEAD_OPEN;
                head = max(head, carried);
            }
            if (seeds && way == 0 && feeds(cell))
                head = max(head, uint(surface_quarters(cell.y, content)) << HEAD_HEIGHT_SHIFT | HEAD_REACH | HEAD_OPEN);
            carried = head;
            if (head == before) continue;
            imageStore(building_head, cell, uvec4(head));
            new_here = true;
        }
    }
    if (new_here) found = 1u;
}
