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
    vec2 gradient;   // of the level along x and z, where it was asked for and the surface met
};

// Height of the water's surface in the column of `cell`, at most a voxel above or below it.
float water_level(ivec3 cell, float otherwise) {
    uint here = cell_byte(cell);
    bool full = here == MATERIAL_WATER_FULL;
    ivec3 next = cell + ivec3(0, full ? 1 : -1, 0);
    uint value = cell_byte(next);
    bool own = is_partly_filled(here) || (full && value == MATERIAL_AIR);
    bool of_next = full ? is_partly_filled(value) : here == MATERIAL_AIR && is_water(value);
    return own ? surface_height(cell, here) : of_next ? surface_height(next, value) : otherwise;
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

// Where a hit at `point` lies on water's surface towards air: on top of it, or on the side of a low step. The gradient
// is that at the voxel's corners, bilinear between them, so that normals are continuous from voxel to voxel.
WaterFace water_face(uint medium, vec3 dir, RayHit hit, vec3 point, bool with_gradient) {
    bool from_air = medium == MATERIAL_AIR;
    ivec3 wet = from_air ? hit.cell : hit.previous;
    ivec3 dry = from_air ? hit.previous : hit.cell;
    WaterFace face;
    face.is_smooth = false;
    face.met = from_air ? dir.y < 0.0 : dir.y > 0.0;
    face.gradient = vec2(0.0);
    bool top = hit.kind == HIT_SURFACE || wet.y < dry.y;
    float level = NO_WATER_LEVEL;
    float lower_level = NO_WATER_LEVEL;
    ivec3 corner = wet;
    vec2 f = vec2(0.0);
    // Columns: that of the water, that of the air, nine around the surface. Where no lane meets water, llvmpipe pays for
    // one of them.
    int columns = hit.kind != HIT_NONE && is_air_to_water(medium, hit.beyond) ? 2 : 0;
    for (int i = 0; i < columns; ++i) {
        int row = i < 5 ? 0 : i < 8 ? 1 : 2;
        int place = i - 2 - 3 * row;
        ivec3 around = corner + ivec3(place, 0, row);
        float found = water_level(i == 0 ? wet : i == 1 ? dry : around, i < 2 ? NO_WATER_LEVEL : level);
        if (i == 0) level = found;
        if (i == 1) {
            lower_level = hit.axis == 1 ? level : found;
            bool low = level > lower_level && level - lower_level <= WATER_STEP_MAX;
            face.is_smooth = level != NO_WATER_LEVEL && (hit.axis == 1 ? top : low);
            // The cell that holds the surface, and its neighbour.
            ivec3 surface = ivec3(wet.x, int(ceil(level)) - 1, wet.z);
            corner = surface - ivec3(1, 0, 1);
            f = clamp(point.xz - vec2(surface.xz), 0.0, 1.0);
            if (with_gradient && face.is_smooth && face.met) columns = 11;
        }
        // Beyond the highest step there is no slope.
        float slope = i < 2 || abs(found - level) > WATER_STEP_MAX ? 0.0 : found - level;
        vec2 at = vec2(place, row);
        vec2 change = mix(mix(f, 1.0 - 2.0 * f, equal(at, vec2(1.0))), f - 1.0, equal(at, vec2(0.0)));
        vec2 weight = mix(mix(f, vec2(1.0), equal(at, vec2(1.0))), 1.0 - f, equal(at, vec2(0.0)));
        face.gradient += 0.5 * slope * change * weight.yx;
    }
    // Above the column of water, or in the water of the lower column.
    float height = from_air ? level : lower_level;
    ivec3 column = from_air || hit.axis == 1 ? wet : dry;
    column.y = from_air ? int(floor(height)) : int(ceil(height)) - 1;
    face.start = RayStart(vec3(point.x, height, point.z), column, medium);
    return face;
}
