// One level of the tree of emissive voxels, from the level below. An invocation a node.
#define EMITTER_ACCESS
#include "lib/emitter_tree.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform int level;

void main() {
    ivec3 node = ivec3(gl_GlobalInvocationID);
    if (!is_emitter_node(node, level)) return;
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        ivec3 child = 2 * node + ivec3(k & 1, (k >> 1) & 1, k >> 2);
        if (is_emitter_node(child, level - 1)) sum += emitter_power[emitter_node_index(child, level - 1)];
    }
    emitter_power[emitter_node_index(node, level)] = sum;
}
