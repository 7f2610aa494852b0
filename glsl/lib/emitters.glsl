// Emissive voxels as lights: sampled by descending their tree in proportion to power over squared distance, then one
// voxel of the brick, then a point on its faces that look at the receiver.
#include "lib/emitter_tree.glsl"
#include "lib/rng.glsl"
#include "lib/traversal.glsl"

// A point that receives light through the half space on one side of an axis-aligned plane.
struct Receiver {
    vec3 at_vox;
    int axis;
    float side;
};

struct EmitterSample {
    vec3 point_vox;  // on a face of the voxel
    ivec3 cell;
    ivec3 outside;  // the cell before that face
    int axis;
    float pdf;  // per area of the face (vox^-2); 0: no light was found
};

// The density per solid angle, at `from_vox`, of a point sampled on a face across `axis`; nothing bends light between.
float pdf_of_direction(float pdf, vec3 from_vox, vec3 point_vox, int axis) {
    vec3 d = point_vox - from_vox;
    return pdf * dot(d, d) * length(d) / max(abs(d[axis]), 1e-12);
}

// How far the box [low, low + width) reaches into the receiver's half space; negative: not at all.
float reach(Receiver to, vec3 low, float width) {
    return to.side > 0.0 ? low[to.axis] + width - to.at_vox[to.axis] : to.at_vox[to.axis] - low[to.axis];
}

float node_importance(Receiver to, ivec3 node, int level) {
    if (!is_emitter_node(node, level)) return 0.0;
    float width = float(BRICK_SIDE << level);
    vec3 low = vec3(node) * width;
    vec3 d = low + 0.5 * width - to.at_vox;
    // Within the ball around the box distance says nothing.
    float distance2 = max(dot(d, d), 0.75 * width * width);
    return reach(to, low, width) > 0.0 ? emitter_power[emitter_node_index(node, level)] / distance2 : 0.0;
}

// Distances from the receiver to the planes of the voxel's faces that look at it; 0 for faces that do not, and for
// those behind which nothing transmits. side: the sign of each face's normal.
vec3 visible_faces(vec3 at_vox, ivec3 cell, out ivec3 side) {
    vec3 low = vec3(cell);
    vec3 above = at_vox - (low + 1.0);
    vec3 below = low - at_vox;
    side = ivec3(mix(vec3(-1.0), vec3(1.0), greaterThan(above, below)));
    vec3 distance = max(max(above, below), vec3(0.0));
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 next = cell;
        next[axis] += side[axis];
        if (inside_world(next) && !transmits(material_of(cell_byte(next)))) distance[axis] = 0.0;
    }
    return distance;
}

int exposed_emitters(ivec3 brick) {
    uvec2 mask = emitter_masks[emitter_node_index(brick, 0)];
    return bitCount(mask.x) + bitCount(mask.y);
}

// Position of set bit `k` (from 0) of 64.
int set_bit(uvec2 mask, int k) {
    int low = bitCount(mask.x);
    bool high = k >= low;
    uint word = high ? mask.y : mask.x;
    for (int i = high ? k - low : k; i > 0; --i) word &= word - 1u;
    return findLSB(word) + (high ? 32 : 0);
}

EmitterSample sample_emitter(Receiver to) {
    EmitterSample result = EmitterSample(vec3(0.0), ivec3(0), ivec3(0), 0, 0.0);
    float pdf = 1.0;
    ivec3 node = ivec3(0);
    for (int level = emitter_depth.x - 2; level >= 0; --level) {
        // One of eight in one pass: each replaces what was chosen with its part of the sum so far.
        float u = rng_float();
        float sum = 0.0;
        float chosen = 0.0;
        ivec3 child = 2 * node;
        for (int k = 0; k < 8; ++k) {
            ivec3 candidate = 2 * node + ivec3(k & 1, (k >> 1) & 1, k >> 2);
            float importance = node_importance(to, candidate, level);
            sum += importance;
            float part = importance > 0.0 ? importance / sum : 0.0;
            bool taken = u < part;
            u = clamp(taken ? u / part : (u - part) / (1.0 - part), 0.0, 0.99999994);
            if (taken) {
                chosen = importance;
                child = candidate;
            }
        }
        pdf *= sum > 0.0 ? chosen / sum : 0.0;
        node = child;
    }
    int count = exposed_emitters(node);
    int chosen_bit = clamp(int(rng_float() * float(count)), 0, max(count - 1, 0));
    int bit = max(set_bit(emitter_masks[emitter_node_index(node, 0)], chosen_bit), 0);
    ivec3 cell = node * BRICK_SIDE + ivec3(bit & 3, (bit >> 2) & 3, bit >> 4);
    ivec3 side;
    vec3 distance = visible_faces(to.at_vox, cell, side);
    float sum = distance.x + distance.y + distance.z;
    vec2 u = rng_vec2();
    float choice = rng_float() * sum;
    int axis = choice < distance.x ? 0 : choice < distance.x + distance.y ? 1 : 2;
    vec3 within = axis == 0 ? vec3(0.0, u) : axis == 1 ? vec3(u.y, 0.0, u.x) : vec3(u, 0.0);
    within[axis] = side[axis] > 0 ? 1.0 : 0.0;
    result.point_vox = vec3(cell) + within;
    result.cell = cell;
    result.outside = cell;
    result.outside[axis] += side[axis];
    result.axis = axis;
    // In proportion to cosine times distance: about the same density per solid angle on all three.
    if (pdf > 0.0 && count > 0 && sum > 0.0) result.pdf = pdf / float(count) * distance[axis] / sum;
    return result;
}

// The density with which sample_emitter finds a point on the face across `axis` of the emissive voxel `cell`.
float emitter_pdf(Receiver to, ivec3 cell, int axis) {
    float pdf = 1.0;
    ivec3 brick = cell / BRICK_SIDE;
    for (int level = emitter_depth.x - 2; level >= 0; --level) {
        ivec3 first = (brick >> (level + 1)) * 2;
        float sum = 0.0;
        for (int k = 0; k < 8; ++k)
            sum += node_importance(to, first + ivec3(k & 1, (k >> 1) & 1, k >> 2), level);
        float chosen = node_importance(to, brick >> level, level);
        pdf *= chosen > 0.0 ? chosen / sum : 0.0;
    }
    ivec3 side;
    vec3 distance = visible_faces(to.at_vox, cell, side);
    float sum = distance.x + distance.y + distance.z;
    int count = exposed_emitters(brick);
    return count > 0 && sum > 0.0 ? pdf / float(count) * distance[axis] / sum : 0.0;
}
