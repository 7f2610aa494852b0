// Counts the cells of each byte. An invocation walks a column of COLUMN cells and adds each run of equal bytes at
// once, to its workgroup's counters first.
#include "shared/bindings.h"

#define COLUMN 32
layout(local_size_x = 8, local_size_y = 1, local_size_z = 8) in;

layout(binding = BINDING_CELLS) uniform usampler3D cells;
// At most 2^30 cells: 32 bits hold every count.
layout(std430, binding = 0) buffer CellCounts { uint counts[256]; };

shared uint local_counts[256];

void main() {
    for (uint i = gl_LocalInvocationIndex; i < 256u; i += 64u) local_counts[i] = 0u;
    barrier();
    ivec3 size = textureSize(cells, 0);
    ivec3 cell = ivec3(gl_GlobalInvocationID) * ivec3(1, COLUMN, 1);
    if (cell.x < size.x && cell.z < size.z) {
        uint run_byte = 0u;
        uint run = 0u;
        for (int end = min(cell.y + COLUMN, size.y); cell.y < end; ++cell.y) {
            uint byte = texelFetch(cells, cell, 0).r;
            if (byte != run_byte && run > 0u) {
                atomicAdd(local_counts[run_byte], run);
                run = 0u;
            }
            run_byte = byte;
            ++run;
        }
        if (run > 0u) atomicAdd(local_counts[run_byte], run);
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < 256u; i += 64u)
        if (local_counts[i] > 0u) atomicAdd(counts[i], local_counts[i]);
}
