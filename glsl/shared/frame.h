// The per-frame uniform block: one list of fields, a struct in C++ and a std140 block in GLSL. Only mat4, vec4,
// ivec4 and uvec4, so that both layouts agree (a test compares GL_OFFSET with offsetof).
#ifndef TARN_SHARED_FRAME
#define TARN_SHARED_FRAME
#include "shared/bindings.h"
#include "shared/language.h"

// A ray through normalised device coordinates (u, v) in [-1,1]^2 has the direction dir + u * right + v * up.
#define TARN_FRAME_FIELDS(F)                                                                             \
    F(vec4, camera_position_vox) /* xyz */                                                               \
    F(vec4, camera_dir)          /* xyz: unit, through the centre of the picture */                      \
    F(vec4, camera_right)        /* xyz: scaled by tan(fov / 2) * aspect */                              \
    F(vec4, camera_up)           /* xyz: scaled by tan(fov / 2) */                                       \
    F(vec4, previous_position_vox)                                                                       \
    F(vec4, previous_dir)                                                                                \
    F(vec4, previous_right)                                                                              \
    F(vec4, previous_up)                                                                                 \
    F(ivec4, world_size_vox)   /* xyz; w: 1 while a previous frame exists */                             \
    F(uvec4, counters)         /* frame index, seed, samples per pixel, samples kept in exact mode */    \
    F(vec4, sun_dir)           /* xyz: towards the sun; w: 1 - cosine of the angular radius */               \
    F(vec4, sun_irradiance)    /* rgb on a surface that faces it; w: solid angle in sr, 0 for a point */ \
    F(vec4, sun_radiance)      /* rgb of the disc, 0 for a point; w: 1 where there is a sun */           \
    F(vec4, sky_zenith)        /* rgb radiance */                                                        \
    F(vec4, sky_horizon)       /* rgb radiance */                                                        \
    F(vec4, sky_perez_a)       /* of the sky preetham: Y (radiance), x, y; a to e of Perez's function */ \
    F(vec4, sky_perez_b)                                                                                 \
    F(vec4, sky_perez_c)                                                                                 \
    F(vec4, sky_perez_d)                                                                                 \
    F(vec4, sky_perez_e)                                                                                 \
    F(vec4, sky_perez_scale)   /* zenith over the function there */                                      \
    F(vec4, sky_sun_dir)       /* xyz: towards the sun, no lower than the horizon */                     \
    F(vec4, sky_night)         /* rgb radiance that is left without the sun */                           \
    F(vec4, trace_limits)      /* max distance (vox), metres per voxel, firefly limit (0: none), unused */ \
    F(ivec4, trace_options)    /* max bounces, roulette after (bounces), max diffuse bounces, OPTION bits */       \
    F(ivec4, size_px)          /* traced width, height; shown width, height */                           \
    F(vec4, history)           /* alpha (blend), cap (samples), place of scattered pixels in their cells */                        \
    F(vec4, display)           /* exposure factor, tone map, unused, unused */

#ifdef __cplusplus
namespace tarn {
struct FrameBlock {
#define TARN_FIELD(type, name) glm::type name{0};
    TARN_FRAME_FIELDS(TARN_FIELD)
#undef TARN_FIELD
};
}  // namespace tarn
#else
layout(std140, binding = BINDING_FRAME) uniform FrameBlock {
#define TARN_FIELD(type, name) type name;
    TARN_FRAME_FIELDS(TARN_FIELD)
#undef TARN_FIELD
} frame;
#endif
#endif
