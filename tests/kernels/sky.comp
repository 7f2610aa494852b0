// glsl/lib/sky.glsl under test: the radiance of many directions.
#include "lib/sky.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Dirs { vec4 dirs[]; };
layout(std430, binding = 1) writeonly buffer Result { vec4 radiance[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(dirs.length())) return;
    radiance[i] = vec4(sky_radiance(dirs[i].xyz), in_sun_disc(dirs[i].xyz) ? 1.0 : 0.0);
}
