// The leaves of the tree of emissive voxels: what the bricks that changed, or touch one that did, hold. An invocation a
// changed brick. Where a leaf changed, the levels above are dispatched anew.
#define EMITTER_ACCESS
#include "lib/emitter_tree.glsl"
#include "lib/new_changes.glsl"

layout(local_size_x = CHANGES_PER_GROUP) in;

layout(binding = BINDING_CELLS) uniform usampler3D cells;

// Indirect arguments of emitter_tree.comp, by level: 0 groups until something changed.
layout(std430, binding = STORAGE_EMITTER_GROUPS) writeonly buffer EmitterGroups {
    uint emitter_groups[3 * EMITTER_LEVELS_MAX];
};

bool lets_light_out(ivec3 cell) {
    bool inside = all(lessThan(uvec3(cell), uvec3(textureSize(cells, 0))));
    return !inside || transmits(material_of(texelFetch(cells, cell, 0).r));
}

void look_at(ivec3 brick) {
    bool stale = is_emitter_node(brick, 0);
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
    int index = stale ? emitter_node_index(brick, 0) : 0;
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

void main() {
    uint item = new_change_item();
    if (!is_new_change(item)) return;
    uint id = new_change(item);
    uvec3 bricks = uvec3(emitter_levels[0].xyz);
    ivec3 brick = ivec3(id % bricks.x, id / bricks.x % bricks.y, id / (bricks.x * bricks.y));
    // The brick, then the six beside it; these have an invocation of their own where all are looked at.
    int count = new_changes_all != 0u ? 1 : 7;
    for (int k = 0; k < count; ++k) {
        ivec3 at = brick;
        if (k > 0) at[(k - 1) >> 1] += 2 * (k & 1) - 1;
        look_at(at);
    }
}
