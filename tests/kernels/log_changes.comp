// Logs bricks first .. first + count - 1, an invocation each.
#include "lib/changes.glsl"

layout(local_size_x = 64) in;

uniform uint first;
uniform uint count;

void main() {
    if (gl_GlobalInvocationID.x < count) append_change(first + gl_GlobalInvocationID.x);
}
