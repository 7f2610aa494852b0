// From radiance to the picture: upsampling, exposure, tone curve, sRGB.
#include "shared/frame.h"
#include "lib/math.glsl"

layout(binding = 4) uniform sampler2D radiance;

layout(location = 0) out vec4 out_picture;

// Fit of the ACES filmic curve (Narkowicz 2015), with the exposure of 0.6 that is usual for it.
vec3 filmic(vec3 x) {
    x *= 0.6;
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

vec3 shown_radiance() {
    if (textureSize(radiance, 0) == frame.size_px.zw) return texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb;
    return textureLod(radiance, gl_FragCoord.xy / vec2(frame.size_px.zw), 0.0).rgb;
}

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
