// Sums for an estimate of a shown picture's relMSE: at one pixel in stride x stride two samples a, b of exact mode,
// which know nothing of the picture nor of each other, so that the expectation of (x - a)(x - b) is the squared error
// of x, whatever it comes from. What that is divided by is made of the same samples: the quotient has a bias, which
// the samples around keep small. TRIAL_MEAN: of the samples' luminance; then the relative errors.
#include "shared/bindings.h"
#include "shared/trial.h"
#include "lib/math.glsl"

layout(local_size_x = TRIAL_LANES) in;

layout(binding = BINDING_FIRST_INPUT) uniform sampler2D picture;       // radiance as shown
layout(binding = BINDING_FIRST_INPUT + 1) uniform sampler2D sample_a;  // of one pixel in stride x stride
layout(binding = BINDING_FIRST_INPUT + 2) uniform sampler2D sample_b;

uniform int stride;

// x: luminance of the samples, y: relative error, z: its square, w: pixels; by workgroup
layout(std430, binding = 0) buffer TrialSums { vec4 trial_sums[TRIAL_GROUPS]; };

shared vec4 lanes[TRIAL_LANES];

vec2 samples_at(ivec2 at) {
    return vec2(luminance(texelFetch(sample_a, at, 0).rgb), luminance(texelFetch(sample_b, at, 0).rgb));
}

#ifndef TRIAL_MEAN
// What the error is relative to: of the pixel's true luminance the picture may be far off where it errs, the samples
// around at an edge, the two of the pixel are noise, so the one in the middle.
float luminance_scale(ivec2 at, float shown, float sampled) {
    ivec2 last = textureSize(sample_a, 0) - 1;
    vec2 sum = vec2(0.0);  // luminance, samples
    for (int i = 0; i < 9; ++i) {
        ivec2 tap = at + ivec2(i % 3 - 1, i / 3 - 1);
        ivec2 inside = clamp(tap, ivec2(0), last);
        vec2 ab = samples_at(inside);
        sum += i != 4 && tap == inside && is_finite(vec3(ab, 0.0)) ? vec2(ab.x + ab.y, 2.0) : vec2(0.0);
    }
    float around = sum.y > 0.0 ? sum.x / sum.y : 0.5 * (shown + sampled);
    return max(min(shown, sampled), min(max(shown, sampled), around));
}
#endif

void main() {
    ivec2 size = textureSize(sample_a, 0);
    int count = size.x * size.y;
#ifndef TRIAL_MEAN
    vec2 total = vec2(0.0);
    for (int i = 0; i < TRIAL_GROUPS; ++i) total += trial_sums[i].xw;
    float mean = total.x / max(total.y, 1.0);
#endif
    vec4 sum = vec4(0.0);
    for (int i = int(gl_GlobalInvocationID.x); i < count; i += TRIAL_LANES * TRIAL_GROUPS) {
        ivec2 at = ivec2(i % size.x, i / size.x);
        vec2 ab = samples_at(at);
#ifdef TRIAL_MEAN
        bool known = is_finite(vec3(ab, 0.0));
        sum += known ? vec4(0.5 * (ab.x + ab.y), 0.0, 0.0, 1.0) : vec4(0.0);
#else
        float x = luminance(texelFetch(picture, min(at * stride + stride / 2, textureSize(picture, 0) - 1), 0).rgb);
        float scale = luminance_scale(at, x, 0.5 * (ab.x + ab.y));
        float relative = (x - ab.x) * (x - ab.y) / max(scale * scale + 0.01 * mean * mean, 1e-30);
        bool known = is_finite(vec3(relative, relative * relative, 0.0));
        sum.yz += known ? vec2(relative, relative * relative) : vec2(0.0);
#endif
    }
    uint lane = gl_LocalInvocationIndex;
    lanes[lane] = sum;
    barrier();
    for (uint half_lanes = uint(TRIAL_LANES) / 2u; half_lanes > 0u; half_lanes /= 2u) {
        if (lane < half_lanes) lanes[lane] += lanes[lane + half_lanes];
        barrier();
    }
    if (lane != 0u) return;
#ifdef TRIAL_MEAN
    trial_sums[gl_WorkGroupID.x] = lanes[0];
#else
    trial_sums[gl_WorkGroupID.x].yz = lanes[0].yz;
#endif
}
