// Constants that the path tracer and its set-up agree on; C++ and GLSL.
#ifndef TARN_SHARED_TRACE
#define TARN_SHARED_TRACE
#include "shared/language.h"
TARN_SHARED_BEGIN

// Bits of frame.trace_options.w.
TARN_CONSTANT int OPTION_SUN_THROUGH_WATER = 1;
TARN_CONSTANT int OPTION_CAUSTICS = 2;
TARN_CONSTANT int OPTION_UNIFORM_DIFFUSE = 4;
TARN_CONSTANT int OPTION_JITTER = 8;
TARN_CONSTANT int OPTION_STRAIGHT_SUNLIGHT = 16;
TARN_CONSTANT int OPTION_PREETHAM_SKY = 32;
TARN_CONSTANT int OPTION_LOW_DISCREPANCY = 64;
TARN_CONSTANT int OPTION_SCATTER = 128;  // lib/scatter.glsl
TARN_CONSTANT int OPTION_IMAGE_DISTANCE = 256;  // beside the radiance, where no filter takes it for frames kept

// So far away counts what is mirrored or seen beyond the world.
TARN_CONSTANT float IMAGE_FAR_VOX = 1e6f;

// Below this alpha (roughness^2) a surface is a perfect mirror or interface.
TARN_CONSTANT float ALPHA_SMOOTH = 1e-3f;

// The albedo table's third axis: x in [-1,1] stands for (eta - 1) / (eta + 1) = x |x|^3 ALBEDO_ETA_RANGE, so that its
// samples crowd where coats barely refract and their albedo bends most.
TARN_CONSTANT float ALBEDO_ETA_RANGE = 0.6f;

// For eta >= 1 the table holds what is to be added to Fresnel's reflectance at the cosine
// sqrt((cos^2 + ALBEDO_FACET_SPREAD alpha^2 sin^2) / (1 + alpha^2)), near that of the facets seen: it bends far less.
TARN_CONSTANT float ALBEDO_FACET_SPREAD = 2.0f;

// In place of a material's id where a ray meets the sky.
TARN_CONSTANT TARN_UINT SURFACE_SKY = 255u;

// Along x and along y, one pixel in so many has its last path traced again when water or sand moved, and when an edit
// changed the world. Few paths meet what a mirror shows: with a ninth of them after edits, too, `ghosts_test` prints 17
// frames for a block put up, with a quarter 5.
TARN_CONSTANT TARN_UINT RETRACE_STRIDE = 3u;
TARN_CONSTANT TARN_UINT RETRACE_STRIDE_OF_EDITS = 2u;
// Paths up to so far away along x and y tell of a pixel; twice that is a multiple of either stride.
TARN_CONSTANT TARN_UINT RETRACE_REACH_PX = 3u;

// Most frames in exact mode's mean: a counter of them and of this one ends there.
TARN_CONSTANT TARN_UINT FRAMES_KEPT_MAX = 0xfffffffeu;

TARN_SHARED_END
#endif
