// Where fewer pixels are traced than shown. Which shown pixel a traced one stands for: another one in each frame, so that
// a still picture gets them all. frame.history.zw is where in its cell of shown pixels, in [0,1).
#include "shared/frame.h"
#include "lib/math.glsl"

ivec2 shown_pixel(ivec2 traced) {
    vec2 cell = vec2(frame.size_px.zw) / vec2(frame.size_px.xy);
    return min(ivec2((vec2(traced) + frame.history.zw) * cell), frame.size_px.zw - 1);
}

// Exposed light below this counts about the same.
const float WEIGHED_AS_DARK = 0.2;

// Of light spread over pixels that show something else: the brighter the less, or that of a lamp spills over all dark
// pixels around it.
float weight_among_strangers(vec3 light) {
    return 1.0 / (min(luminance(light) * frame.display.x, 1e30) + WEIGHED_AS_DARK);
}
