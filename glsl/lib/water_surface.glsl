// How water is shaded where neighbouring voxels hold different amounts: as the smooth surface through their levels.
// The low steps between them count as parts of it. Owns the normal and where rays go on; geometry is traversal's.
#include "lib/traversal.glsl"

// Steps between neighbouring levels (vox) up to this are shaded as slopes; higher ones are walls of water. With 1 the
// front of a breaking dam, whose steps lie about there, is a patchwork of both.
const float WATER_STEP_MAX = 0.5;
const float NO_WATER_LEVEL = -1e9;

// A hit on smooth water: the face counts as horizontal whatever its geometry.
struct WaterFace {
    bool is_smooth;  // else the rest means nothing
    bool met;        // false on a low step's side that a smooth surface would not have shown to the ray
    RayStart start;  // of rays that stay on the ray's side: on the level of the column there
    ivec3 surface;   // the cell that holds the surface, of height `level`
    float level;
};

// Height of the water's surface in the column of `cell`, at most a voxel above or below it.
float water_level(ivec3 cell, float otherwise) {
    uint here = byte_or_air(cell);
    bool full = here == MATERIAL_WATER_FULL;
    ivec3 next = cell + ivec3(0, full ? 1 : -1, 0);
    uint value = byte_or_air(next);
    bool own = is_partly_filled(here) || (full && value == MATERIAL_AIR);
    bool of_next = full ? is_partly_filled(value) : here == MATERIAL_AIR && is_water(value);
    return own ? surface_height(cell, here) : of_next ? surface_height(next, value) : otherwise;
}

// Levels of three columns along x around `cell`, against its own; beyond the highest step there is no slope.
vec3 levels_around(ivec3 cell, float level) {
    vec3 levels = vec3(water_level(cell - ivec3(1, 0, 0), level), water_level(cell, level),
                       water_level(cell + ivec3(1, 0, 0), level)) -
                  level;
    return mix(levels, vec3(0.0), greaterThan(abs(levels), vec3(WATER_STEP_MAX)));
}

// Gradient of the level along x and z: that at the voxel's corners, bilinear between them, so that normals are
// continuous from voxel to voxel. `cell` holds the surface, of height `level`.
vec2 water_gradient(vec3 at_vox, ivec3 cell, float level) {
    vec2 f = clamp(at_vox.xz - vec2(cell.xz), 0.0, 1.0);
    vec3 back = levels_around(cell - ivec3(0, 0, 1), level);
    vec3 here = levels_around(cell, level);
    vec3 front = levels_around(cell + ivec3(0, 0, 1), level);
    vec3 weight_x = vec3(1.0 - f.x, 1.0, f.x);
    vec3 weight_z = vec3(1.0 - f.y, 1.0, f.y);
    vec3 along_x = vec3(mix(back.y - back.x, back.z - back.y, f.x), mix(here.y - here.x, here.z - here.y, f.x),
                        mix(front.y - front.x, front.z - front.y, f.x));
    vec3 along_z = mix(here - back, front - here, f.y);
    return 0.5 * vec2(dot(along_x, weight_z), dot(along_z, weight_x));
}

// The normal on the side of `wo` (side: 1 above the water, -1 below), bent back towards the vertical just as far as a
// reflection needs to stay on that side.
vec3 water_normal(vec2 gradient, float side, vec3 wo) {
    float up = side * wo.y;
    float against = side * dot(gradient, wo.xz);
    float bent = against + sqrt(against * against + dot(gradient, gradient) * up * up);
    gradient *= min(1.0, up / max(bent, 1e-20));
    return side * normalize(vec3(-gradient.x, 1.0, -gradient.y));
}

// Where a hit at `point` lies on water's surface towards air: on top of it, or on the side of a low step.
WaterFace water_face(uint medium, vec3 dir, RayHit hit, vec3 point) {
    bool from_air = medium == MATERIAL_AIR;
    ivec3 wet = from_air ? hit.cell : hit.previous;
    ivec3 dry = from_air ? hit.previous : hit.cell;
    bool to_other = hit.kind != HIT_NONE && (from_air ? hit.beyond == MATERIAL_WATER
                                                      : medium == MATERIAL_WATER && hit.beyond == MATERIAL_AIR);
    float level = water_level(wet, NO_WATER_LEVEL);
    float lower_level = hit.axis == 1 ? level : water_level(dry, NO_WATER_LEVEL);
    bool top = hit.kind == HIT_SURFACE || wet.y < dry.y;
    bool low = level > lower_level && level - lower_level <= WATER_STEP_MAX;
    WaterFace face;
    face.is_smooth = to_other && level != NO_WATER_LEVEL && (hit.axis == 1 ? top : low);
    face.met = from_air ? dir.y < 0.0 : dir.y > 0.0;
    face.surface = ivec3(wet.x, int(ceil(level)) - 1, wet.z);
    face.level = level;
    // Above the column of water, or in the water of the lower column.
    float height = from_air ? level : lower_level;
    ivec3 column = from_air || hit.axis == 1 ? wet : dry;
    column.y = from_air ? int(floor(height)) : int(ceil(height)) - 1;
    face.start = RayStart(vec3(point.x, height, point.z), column, medium);
    return face;
}
