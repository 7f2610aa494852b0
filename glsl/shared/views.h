// The views of what the renderer knows besides the picture: their numbers, scales and colours; C++ and GLSL.
#ifndef TARN_SHARED_VIEWS
#define TARN_SHARED_VIEWS
#include "shared/language.h"

#ifdef __cplusplus
#define TARN_VEC3 glm::vec3
#else
#define TARN_VEC3 vec3
#endif

// In the order of the setting `view`.
#define VIEW_PICTURE 0
#define VIEW_ALBEDO 1
#define VIEW_NORMAL 2
#define VIEW_DEPTH 3
#define VIEW_MATERIAL 4
#define VIEW_BOUNCES 5
#define VIEW_STEPS 6
#define VIEW_HISTORY 7
#define VIEW_VARIANCE 8

TARN_SHARED_BEGIN

// Raw value where there is none: the depth of the sky, the variance of one frame.
TARN_CONSTANT float VIEW_NOTHING = -1.0f;

// Colours run over log(value + offset) from low to high; bounces begin at 0.
TARN_FUNCTION bool view_has_scale(int view) { return view == VIEW_DEPTH || view >= VIEW_BOUNCES; }
TARN_FUNCTION float view_offset(int view) { return view == VIEW_BOUNCES ? 1.0f : 0.0f; }
TARN_FUNCTION float view_low(int view) { return view == VIEW_BOUNCES ? 0.0f : view == VIEW_VARIANCE ? 1e-6f : 1.0f; }
TARN_FUNCTION float view_high(int view) {
    return view == VIEW_BOUNCES ? 63.0f : view == VIEW_HISTORY ? 4096.0f : view == VIEW_VARIANCE ? 1.0f : 1024.0f;
}

// sRGB codes from dark to bright for t in [0,1]: a fit of matplotlib's inferno (Smith & van der Walt 2015; Zucker 2019).
TARN_FUNCTION TARN_VEC3 view_color(float t) {
    return TARN_VEC3(0.000219f, 0.001651f, -0.019481f) +
           t * (TARN_VEC3(0.106513f, 0.563956f, 3.932712f) +
                t * (TARN_VEC3(11.602493f, -3.972854f, -15.942394f) +
                     t * (TARN_VEC3(-41.703996f, 17.436399f, 44.354145f) +
                          t * (TARN_VEC3(77.162936f, -33.402359f, -81.807309f) +
                               t * (TARN_VEC3(-71.319428f, 32.626064f, 73.209520f) +
                                    t * TARN_VEC3(25.131126f, -12.242669f, -23.070325f))))));
}

// One component of a saturated hue; both in turns.
TARN_FUNCTION float view_hue(float hue, float shift) {
    float h = hue + shift;
    h = 6.0f * (h - float(int(h))) - 3.0f;
    h = (h < 0.0f ? -h : h) - 1.0f;
    return h < 0.0f ? 0.0f : h > 1.0f ? 1.0f : h;
}

// sRGB codes that tell material ids apart. By this step the hues of the named ones are 0.09 of a turn apart at least,
// and water is blue.
TARN_FUNCTION TARN_VEC3 view_material_color(TARN_UINT id) {
    float hue = 0.55f + 0.454f * float(id);
    float bright = 1.0f - 0.2f * float(id % 3u);
    return bright * (TARN_VEC3(0.25f) + 0.75f * TARN_VEC3(view_hue(hue, 0.0f), view_hue(hue, 2.0f / 3.0f),
                                                          view_hue(hue, 1.0f / 3.0f)));
}

TARN_SHARED_END
#endif
