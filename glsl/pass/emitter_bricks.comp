// The leaves of the tree of emissive voxels: what the bricks that changed, or touch one that did, hold. An invocation a
// brick. Where a leaf changed, the levels above are dispatched anew.
#define EMITTER_ACCESS
#include "lib/emitter_tree.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;

layout(binding = BINDING_CELLS) uniform usampler3D cells;
layout(binding = BINDING_BRICK_CHANGED) uniform usampler3D brick_changed;

// Indirect arguments of emitter_tree.comp, by level: 0 groups until something changed.
layout(std430, binding = STORAGE_EMITTER_GROUPS) writeonly buffer EmitterGroups {
    uint emitter_groups[3 * EMITTER_LEVELS_MAX];
};

uniform uint seen_version;  // bricks stamped since are looked at anew
uniform int everything;     // 1: all are

bool changed(ivec3 brick) {
    bool inside = is_emitter_node(brick, 0);
    // Stamps wrap: compare by signed difference.
    return inside && int(texelFetch(brick_changed, brick, 0).r - seen_version) > 0;
}

bool lets_light_out(ivec3 cell) {
    bool inside = all(lessThan(uvec3(cell), uvec3(textureSize(cells, 0))));
    return !inside || transmits(material_of(texelFetch(cells, cell, 0).r));
}

void main() {
    ivec3 brick = ivec3(gl_GlobalInvocationID);
    if (!is_emitter_node(brick, 0)) return;
    bool stale = everything != 0 || changed(brick);
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 step = ivec3(axis == 0, axis == 1, axis == 2);
        stale = stale || changed(brick - step) || changed(brick + step);
    }
    ivec3 first = brick * BRICK_SIDE;
    ivec3 size = textureSize(cells, 0);
    uvec2 mask = uvec2(0u);
    float power = 0.0;
    for (int i = 0; i < BRICK_SIDE * BRICK_SIDE * BRICK_SIDE && stale; ++i) {
        ivec3 cell = first + ivec3(i & 3, (i >> 2) & 3, i >> 4);
        uint value = all(lessThan(cell, size)) ? texelFetch(cells, cell, 0).r : MATERIAL_AIR;
        int exposed = 0;
        for (int face = 0; face < 6 && is_emitter(value); ++face) {
            ivec3 next = cell;
            next[face >> 1] += 2 * (face & 1) - 1;
            exposed += lets_light_out(next) ? 1 : 0;
        }
        power += float(exposed) * luminance(materials[value].emission_metallic.rgb);
        if (exposed > 0) mask[i >> 5] |= 1u << (i & 31);
    }
    int index = emitter_node_index(brick, 0);
    // A loop that runs at most once: llvmpipe runs the body of a branch for lanes that do not take it.
    for (bool differs = stale && (emitter_masks[index] != mask || emitter_power[index] != power); differs;
         differs = false) {
        emitter_masks[index] = mask;
        emitter_power[index] = power;
        for (int level = 1; level < emitter_depth.x; ++level) {
            ivec3 groups = (emitter_levels[level].xyz + 3) / 4;
            for (int axis = 0; axis < 3; ++axis) emitter_groups[3 * level + axis] = uint(groups[axis]);
        }
    }
}
