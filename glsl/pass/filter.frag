// One direction of a separable 5-tap blur. Gaussian: over everything. Otherwise within one surface of one material, and
// less the more frames a pixel has.
#include "shared/frame.h"
#include "lib/materials.glsl"
#include "lib/math.glsl"
#include "lib/surface.glsl"

layout(binding = 4) uniform sampler2D radiance;  // rgb; a: frames kept
layout(binding = 5) uniform sampler2D surface;

uniform ivec2 step_px;  // distance and direction of neighbouring taps

layout(location = 0) out vec4 out_radiance;

const float KERNEL[3] = float[3](6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);  // binomial

// With fewer frames the brightness of a pixel behind water says nothing yet.
const float FRAMES_OF_NOISE = 12.0;

const float WIDE_FRAMES = 8.0;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(radiance, 0) - 1;
    vec4 center = texelFetch(radiance, at, 0);
#ifdef FILTER_GAUSSIAN
    vec3 sum = center.rgb * KERNEL[0];
    for (int i = -2; i <= 2; ++i) {
        if (i != 0) sum += texelFetch(radiance, clamp(at + i * step_px, ivec2(0), last), 0).rgb * KERNEL[abs(i)];
    }
    out_radiance = vec4(sum, center.a);
#else
    vec4 here = texelFetch(surface, at, 0);
    if (here.w == SURFACE_CODE_SKY) {
        out_radiance = center;
        return;
    }
    vec3 n = surface_normal(here.w);
    // Where frames have been averaged there is less noise to trade for sharpness.
    float strength = min(1.0, 6.0 / center.a);
    // Wider passes are for pixels that have next to no history.
    if (max(step_px.x, step_px.y) > 1) strength = max(0.0, 1.0 - center.a / WIDE_FRAMES);
    if (strength == 0.0) {
        out_radiance = center;
        return;
    }
    bool clear = transmits(surface_material(here.w));
    float center_luminance = luminance(center.rgb);
    float tolerance = plane_tolerance(here, frame.camera_position_vox.xyz);
    vec3 sum = center.rgb * KERNEL[0];
    float weight_sum = KERNEL[0];
    for (int i = -2; i <= 2; ++i) {
        ivec2 tap = at + i * step_px;
        if (i == 0 || any(lessThan(tap, ivec2(0))) || any(greaterThan(tap, last))) continue;
        if (!lies_on(here, texelFetch(surface, tap, 0), n, tolerance)) continue;
        vec3 value = texelFetch(radiance, tap, 0).rgb;
        float w = KERNEL[abs(i)] * strength;
        // Behind a clear surface lies a picture of its own: keep its edges by brightness, once there is more to see
        // than noise.
        if (clear && center.a > FRAMES_OF_NOISE)
            w *= exp(-abs(luminance(value) - center_luminance) / (0.1 + 0.25 * center_luminance));
        sum += w * value;
        weight_sum += w;
    }
    out_radiance = vec4(sum / weight_sum, center.a);
#endif
}
