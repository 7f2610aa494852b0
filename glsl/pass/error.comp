// Sums over the picture for an estimate of its relMSE: of the luminance (ERROR_MEAN), and then of the variance relative
// to it. A fixed number of workgroups strides over the pixels, so that what is read back is small, and over no more than
// ERROR_PIXELS of them, evenly spread: enough for an estimate.
#include "shared/bindings.h"
#include "shared/error.h"
#include "lib/math.glsl"

layout(local_size_x = ERROR_LANES) in;

layout(binding = BINDING_FIRST_INPUT) uniform sampler2D variance;  // of the mean's luminance; VIEW_NOTHING: not known
layout(binding = BINDING_FIRST_INPUT + 1) uniform sampler2D radiance;

// x: luminance, y: relative variance, z: pixels with a variance, w: pixels; by workgroup
layout(std430, binding = 0) buffer ErrorSums { vec4 error_sums[ERROR_GROUPS]; };

shared vec4 lanes[ERROR_LANES];

void main() {
    ivec2 size = textureSize(radiance, 0);
    uint pixels = uint(size.x) * uint(size.y);
    // Odd, so that it meets every column of a picture whose width is a power of two.
    uint step_px = (pixels / uint(ERROR_PIXELS)) | 1u;
    vec4 sum = vec4(0.0);
#ifndef ERROR_MEAN
    vec2 total = vec2(0.0);
    for (int i = 0; i < ERROR_GROUPS; ++i) total += error_sums[i].xw;
    float mean = total.x / total.y;
#endif
    for (uint i = step_px * gl_GlobalInvocationID.x; i < pixels; i += step_px * uint(ERROR_LANES * ERROR_GROUPS)) {
        ivec2 at = ivec2(int(i % uint(size.x)), int(i / uint(size.x)));
        float y = luminance(texelFetch(radiance, at, 0).rgb);
#ifdef ERROR_MEAN
        sum.x += is_finite(vec3(y)) ? y : 0.0;
        sum.w += 1.0;
#else
        float v = texelFetch(variance, at, 0).r;
        float relative = v / max(y * y + 0.01 * mean * mean, 1e-30);
        bool known = v >= 0.0 && is_finite(vec3(relative));
        sum.y += known ? relative : 0.0;
        sum.z += known ? 1.0 : 0.0;
#endif
    }
    uint lane = gl_LocalInvocationIndex;
    lanes[lane] = sum;
    barrier();
    for (uint half_lanes = uint(ERROR_LANES) / 2u; half_lanes > 0u; half_lanes /= 2u) {
        if (lane < half_lanes) lanes[lane] += lanes[lane + half_lanes];
        barrier();
    }
    if (lane != 0u) return;
#ifdef ERROR_MEAN
    error_sums[gl_WorkGroupID.x] = lanes[0];
#else
    error_sums[gl_WorkGroupID.x].yz = lanes[0].yz;
#endif
}
