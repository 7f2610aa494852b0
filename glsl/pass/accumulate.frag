// Exact mode: adds a frame to a sum over all frames, which is two float32 (Dekker 1971): a plain float32 running mean
// drifts by 1 % in a million frames.
#include "shared/frame.h"
#include "shared/trace.h"
#include "lib/math.glsl"

layout(binding = 0) uniform sampler2D radiance;
layout(binding = 1) uniform sampler2D previous_sum;         // rgb; a: sum of the luminance's squared deviations
layout(binding = 2) uniform sampler2D previous_correction;  // of the four sums
layout(binding = 3) uniform sampler2D previous_mean;        // rgb; a: frames lost to the guard

layout(location = 0) out vec4 out_sum;
layout(location = 1) out vec4 out_correction;
layout(location = 2) out vec4 out_mean;

layout(std430, binding = 0) buffer RejectedBlock { uint rejected_samples; };

// Of one frame's squared deviation, so that 2^32 frames add up to a float: a luminance of 1e14.
const float DEVIATION_MAX = 1e28;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 radiance_now = texelFetch(radiance, at, 0).rgb;
    bool first = frame.counters.w == 0u;
    vec4 sum = first ? vec4(0.0) : texelFetch(previous_sum, at, 0);
    vec4 correction = first ? vec4(0.0) : texelFetch(previous_correction, at, 0);
    vec4 before = first ? vec4(0.0) : texelFetch(previous_mean, at, 0);
    uint missing = is_finite(before.a) ? uint(before.a) : 0u;
    // Counted in integers: a float stops at 2^24, the counter at FRAMES_KEPT_MAX, where the mean stays as it is.
    uint kept = frame.counters.w - missing;
    uint taken = frame.counters.w < FRAMES_KEPT_MAX ? 1u : 0u;
    if (!is_finite(sum) || !is_finite(correction) || !is_finite(before)) {
        atomicAdd(rejected_samples, 1u);
        sum = vec4(0.0);
        correction = vec4(0.0);
        before = vec4(0.0);
        // As many as a float holds; this frame stands for the few that remain.
        int lost_bits = max(0, findMSB(frame.counters.w) - 23);
        missing = (frame.counters.w >> lost_bits) << lost_bits;
        taken = frame.counters.w - missing + 1u;
        kept = 0u;
    }
    float count = float(kept + taken);
    // Welford 1962.
    float deviation = luminance(radiance_now) - luminance(before.rgb);
    float deviations = min(deviation * deviation, DEVIATION_MAX) * (float(kept) / count);
    vec4 value = float(taken) * vec4(radiance_now, deviations);
    precise vec4 total = sum + value;
    precise vec4 from_sum = (sum - total) + value;
    precise vec4 from_value = (value - total) + sum;
    precise vec4 rest = correction + mix(from_value, from_sum, greaterThanEqual(abs(sum), abs(value)));
    // The rest is kept below the sum's last place: left to grow, it loses digits of its own in a million frames.
    precise vec4 high = total + rest;
    precise vec4 low = rest - (high - total);
    out_sum = high;
    out_correction = low;
    out_mean = vec4((high.rgb + low.rgb) / count, float(missing));
}
