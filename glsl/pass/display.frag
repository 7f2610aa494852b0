// From radiance to the picture: upsampling, exposure, tone curve, sRGB.
#include "shared/bindings.h"
#include "shared/frame.h"
#include "lib/math.glsl"
#include "lib/scatter.glsl"

layout(rgba32f, binding = IMAGE_RADIANCE) readonly restrict uniform image2D radiance;
#ifdef DISPLAY_REFINED
layout(binding = 4) uniform sampler2D exact_mean;
layout(binding = 5) uniform sampler2D exact_sum;  // a: sum of the luminance's squared deviations
uniform float exact_samples;
#endif

layout(location = 0) out vec4 out_picture;

// Fit of the ACES filmic curve (Narkowicz 2015), with the exposure of 0.6 that is usual for it.
vec3 filmic(vec3 x) {
    x *= 0.6;
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

vec3 preset_radiance(ivec2 at) {
    ivec2 last = imageSize(radiance) - 1;
    if (last + 1 == frame.size_px.zw) return imageLoad(radiance, at).rgb;
    // Bilinear, but for the weights: relMSE of `fast` at scale .45, still, in `cave` 8.0, so .29; in `lake` .080 and .071.
    vec2 between = (vec2(at) + 0.5) * vec2(last + 1) / vec2(frame.size_px.zw) - 0.5;
    vec2 f = fract(between);
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
        ivec2 tap = clamp(ivec2(floor(between)) + ivec2(k & 1, k >> 1), ivec2(0), last);
        vec3 light = imageLoad(radiance, tap).rgb;
        vec2 w = mix(1.0 - f, f, vec2(k & 1, k >> 1));
        sum += w.x * w.y * weight_among_strangers(light) * vec4(light, 1.0);
    }
    return sum.rgb / sum.a;
}

#ifdef DISPLAY_REFINED
// The exact mean, of variance v, has its least error beside another picture of error b with the weight b / (b + v). b is
// their difference around the pixel beyond what v explains; three times v, so that its chance is not taken for b.
const float VARIANCE_DOUBTED = 3.0;
// Samples after which the estimate counts, and the weight that comes without it, for small errors: n / (n + this).
const float SAMPLES_OF_ESTIMATE = 64.0;
const float SAMPLES_TRUSTED = 1024.0;

float weight_of_exact(ivec2 at) {
    float difference = 0.0;
    float deviations = 0.0;
    ivec2 last = frame.size_px.zw - 1;
    for (int k = 0; k < 9; ++k) {
        ivec2 tap = clamp(at + ivec2(k % 3, k / 3) - 1, ivec2(0), last);
        float d = luminance(texelFetch(exact_mean, tap, 0).rgb) - luminance(preset_radiance(tap));
        difference += d * d;
        deviations += texelFetch(exact_sum, tap, 0).a;
    }
    float n = exact_samples;
    float variance = deviations / max(n * (n - 1.0), 1.0);
    float bias = max(difference - VARIANCE_DOUBTED * variance, 0.0);
    float estimated = bias / max(bias + variance, 1e-30) * min(1.0, (n - 1.0) / SAMPLES_OF_ESTIMATE);
    return max(estimated, n / (n + SAMPLES_TRUSTED));
}

vec3 shown_radiance() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    return mix(preset_radiance(at), texelFetch(exact_mean, at, 0).rgb, weight_of_exact(at));
}
#else
vec3 shown_radiance() { return preset_radiance(ivec2(gl_FragCoord.xy)); }
#endif

void main() {
    vec3 linear_rgb = shown_radiance();
#ifdef DISPLAY_RADIANCE
    out_picture = vec4(linear_rgb, 1.0);
#else
    // The curve squares its argument: far beyond white nothing changes any more.
    vec3 exposed = clamp(linear_rgb * frame.display.x, 0.0, 1e4);
    vec3 mapped = frame.display.y > 0.5 ? clamp(exposed, 0.0, 1.0) : filmic(exposed);
    out_picture = vec4(srgb_from_linear(mapped), 1.0);
#endif
}
