// Exact mode: adds a frame to a sum over all frames, with the rounding error carried along (Kahan-Babuska-Neumaier):
// a plain float32 running mean drifts by 1 % in a million frames.
#include "shared/frame.h"
#include "lib/math.glsl"

layout(binding = 0) uniform sampler2D radiance;
layout(binding = 1) uniform sampler2D previous_sum;         // rgb
layout(binding = 2) uniform sampler2D previous_correction;  // rgb; a: frames lost to the guard

layout(location = 0) out vec4 out_sum;
layout(location = 1) out vec4 out_correction;
layout(location = 2) out vec4 out_mean;

layout(std430, binding = 0) buffer RejectedBlock { uint rejected_samples; };

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 value = texelFetch(radiance, at, 0).rgb;
    bool first = frame.counters.w == 0u;
    vec4 sum = first ? vec4(0.0) : texelFetch(previous_sum, at, 0);
    vec3 correction = first ? vec3(0.0) : texelFetch(previous_correction, at, 0).rgb;
    uint missing = first ? 0u : uint(texelFetch(previous_correction, at, 0).a);
    if (!is_finite(sum.rgb) || !is_finite(correction)) {
        atomicAdd(rejected_samples, 1u);
        sum = vec4(0.0);
        correction = vec3(0.0);
        missing = frame.counters.w;
    }
    precise vec3 total = sum.rgb + value;
    precise vec3 from_sum = (sum.rgb - total) + value;
    precise vec3 from_value = (value - total) + sum.rgb;
    correction += mix(from_value, from_sum, greaterThanEqual(abs(sum.rgb), abs(value)));
    out_sum = vec4(total, 0.0);
    out_correction = vec4(correction, float(missing));
    // Counted in integers: a float stops at 2^24.
    out_mean = vec4((total + correction) / float(frame.counters.w + 1u - missing), 1.0);
}
