// Which shown pixel a traced pixel stands for, where fewer are traced than shown: another one in each frame, so that a
// still picture gets them all. frame.history.zw is where in its cell of shown pixels, in [0,1).
#include "shared/frame.h"

ivec2 shown_pixel(ivec2 traced) {
    vec2 cell = vec2(frame.size_px.zw) / vec2(frame.size_px.xy);
    return min(ivec2((vec2(traced) + frame.history.zw) * cell), frame.size_px.zw - 1);
}
