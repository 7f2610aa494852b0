// Reads the whole frame block, for program_test.cpp to ask for its layout and its values.
#include "shared/frame.h"

layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Result { vec4 result; };

void main() {
    result = vec4(frame.camera_position_vox.x, float(frame.counters.y), frame.display.w, 0.0);
}
