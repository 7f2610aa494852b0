// Faces that pixels show, met by other rays of the eye: a surface is looked for among those of the pixels around it and of
// the last frame, for an eye ray for every shown pixel costs more.
#include "lib/camera.glsl"
#include "lib/materials.glsl"
#include "lib/surface.glsl"
#include "lib/traversal.glsl"

// Far less than a voxel or a sixteenth of one.
const float SURFACE_DEPTH_VOX = 0.01;

// How far along the ray from the eye towards `dir` the face that a traced pixel shows goes on, by its plane and by the
// voxels at it; TRAVERSAL_NEVER for the sky, and where the face has ended.
float distance_to(vec4 seen, vec3 eye, vec3 dir) {
    vec3 n = surface_normal(seen.w);
    float t = dot(seen.xyz - eye, n) / dot(dir, n);
    if (!(t > 0.0 && t < TRAVERSAL_T_MAX)) return TRAVERSAL_NEVER;
    vec3 point = eye + t * dir;
    uint id = surface_material(seen.w);
    uint behind = byte_or_air(ivec3(floor(point - SURFACE_DEPTH_VOX * n)));
    uint before = byte_or_air(ivec3(floor(point + SURFACE_DEPTH_VOX * n)));
    bool within = material_of(behind) == id && (material_of(before) != id || is_partly_filled(before));
    // Clear materials are seen from within, too.
    bool from_within = transmits(id) && material_of(before) == id && material_of(behind) != id;
    return within || from_within ? t : TRAVERSAL_NEVER;
}

// Where the ray goes on as if on the plane of `seen`, at least to its end.
vec4 on_plane_of(vec4 seen, vec3 eye, vec3 dir) {
    vec3 n = surface_normal(seen.w);
    float along = seen.w == SURFACE_CODE_SKY ? 1e6 : dot(seen.xyz - eye, n) / dot(dir, n);
    return vec4(eye + clamp(along, 0.0, 1e6) * dir, seen.w);
}
