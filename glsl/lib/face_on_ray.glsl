// Faces that pixels show, met by other rays of the eye: a surface is looked for among those of the pixels around it and
// of the last frame, for an eye ray for every shown pixel costs more.
#include "lib/camera.glsl"
#include "lib/materials.glsl"
#include "lib/surface.glsl"
#include "lib/traversal.glsl"

// Far less than a voxel or a sixteenth of one.
const float SURFACE_DEPTH_VOX = 0.01;

// How far along the ray from the eye towards `dir` the face that a traced pixel shows goes on, by its plane and by the
// voxels at it; TRAVERSAL_NEVER for the sky, and where the face has ended.
float distance_to(uint seen, vec3 eye, vec3 dir) {
    float t = distance_to_plane(seen, eye, dir);
    if (!(t > 0.0 && t < TRAVERSAL_T_MAX)) return TRAVERSAL_NEVER;
    vec3 point = eye + t * dir;
    vec3 n = surface_normal(seen);
    uint id = surface_material(seen);
    uint behind = byte_or_air(ivec3(floor(point - SURFACE_DEPTH_VOX * n)));
    uint before = byte_or_air(ivec3(floor(point + SURFACE_DEPTH_VOX * n)));
    bool within = material_of(behind) == id && (material_of(before) != id || is_partly_filled(before));
    // Clear materials are seen from within, too.
    bool from_within = transmits(id) && material_of(before) == id && material_of(behind) != id;
    return within || from_within ? t : TRAVERSAL_NEVER;
}
