// The layout of the tree of emissive voxels: level 0 holds a node a brick, each level above a node for 2x2x2 below.
// src/passes/emitters.h owns the buffers. EMITTER_ACCESS: readonly where the tree is only read.
#include "shared/bindings.h"
#include "shared/emitters.h"
#include "lib/materials.glsl"
#include "lib/math.glsl"

#ifndef EMITTER_ACCESS
#define EMITTER_ACCESS readonly
#endif

layout(std430, binding = STORAGE_EMITTER_TREE) EMITTER_ACCESS buffer EmitterTree {
    ivec4 emitter_levels[EMITTER_LEVELS_MAX];  // xyz: nodes along each side; w: index of the first
    ivec4 emitter_depth;                       // x: levels
    float emitter_power[];                     // luminance of the exposed faces in a node, summed
};
// Of each brick: the voxels that shine through an exposed face, bit x + 4 y + 16 z.
layout(std430, binding = STORAGE_EMITTER_MASKS) EMITTER_ACCESS buffer EmitterMasks { uvec2 emitter_masks[]; };

bool is_emitter_node(ivec3 node, int level) { return all(lessThan(uvec3(node), uvec3(emitter_levels[level].xyz))); }

int emitter_node_index(ivec3 node, int level) {
    ivec4 at = emitter_levels[level];
    return at.w + node.x + at.x * (node.y + at.y * node.z);
}

bool any_emitter() { return emitter_power[emitter_levels[emitter_depth.x - 1].w] > 0.0; }

// Shining water is found by chance: its surface is no face of a voxel.
bool is_emitter(uint value) { return !is_water(value) && emits(value); }
