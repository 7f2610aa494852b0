// From radiance to the picture: upsampling, exposure, tone curve, sRGB.
#include "shared/frame.h"
#include "lib/math.glsl"
#ifdef DISPLAY_GUIDED
#include "lib/camera.glsl"
#include "lib/materials.glsl"
#include "lib/surface.glsl"
#include "lib/traversal.glsl"
#endif

layout(binding = 4) uniform sampler2D radiance;
#ifdef DISPLAY_GUIDED
layout(binding = 5) uniform sampler2D surface;
#endif

layout(location = 0) out vec4 out_picture;

// Fit of the ACES filmic curve (Narkowicz 2015), with the exposure of 0.6 that is usual for it.
vec3 filmic(vec3 x) {
    x *= 0.6;
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

#ifdef DISPLAY_GUIDED
// How far along the ray from the eye towards `dir` the face that a traced pixel shows goes on, by its plane and by the
// voxels at it; TRAVERSAL_NEVER for the sky, and where the face has ended.
float distance_to(vec4 seen, vec3 eye, vec3 dir) {
    vec3 n = surface_normal(seen.w);
    float t = dot(seen.xyz - eye, n) / dot(dir, n);
    if (!(t > 0.0 && t < TRAVERSAL_T_MAX)) return TRAVERSAL_NEVER;
    vec3 point = eye + t * dir;
    uint id = surface_material(seen.w);
    uint behind = byte_or_air(ivec3(floor(point - 0.01 * n)));
    uint before = byte_or_air(ivec3(floor(point + 0.01 * n)));
    bool within = material_of(behind) == id && (material_of(before) != id || is_partly_filled(before));
    // Clear materials are seen from within, too.
    bool from_within = transmits(id) && material_of(before) == id && material_of(behind) != id;
    return within || from_within ? t : TRAVERSAL_NEVER;
}

// Bilinear over traced pixels; where those four show several surfaces, over those that show the nearest of their
// surfaces which this pixel's ray meets, too.
vec3 shown_radiance() {
    vec2 texel = gl_FragCoord.xy / vec2(frame.size_px.zw) * vec2(frame.size_px.xy) - 0.5;
    ivec2 base = ivec2(floor(texel));
    vec2 f = texel - vec2(base);
    ivec2 last = frame.size_px.xy - 1;
    vec3 eye = frame.camera_position_vox.xyz;
    vec4 seen[4];
    vec4 weights = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    for (int k = 0; k < 4; ++k)
        seen[k] = texelFetch(surface, clamp(base + ivec2(k & 1, k >> 1), ivec2(0), last), 0);
    vec3 n = surface_normal(seen[0].w);
    float tolerance = plane_tolerance(seen[0], eye);
    bool one = true;
    for (int k = 1; k < 4; ++k) one = one && lies_on(seen[0], seen[k], n, tolerance);
    // A loop that runs at most once: llvmpipe runs the body of a branch for lanes that do not take it.
    for (bool once = !one; once; once = false) {
        vec2 size = vec2(frame.size_px.zw);
        vec3 dir = normalize(camera_ray((2.0 * gl_FragCoord.xy - size) / size));
        vec4 here = seen[0];
        float t = 2.0 * TRAVERSAL_NEVER;
        for (int k = 0; k < 4; ++k) {
            float t_k = distance_to(seen[k], eye, dir);
            if (t_k < t || (t_k == t && seen[k].w == SURFACE_CODE_SKY)) {
                t = t_k;
                here = seen[k];
            }
        }
        n = surface_normal(here.w);
        tolerance = plane_tolerance(here, eye);
        for (int k = 0; k < 4; ++k) weights[k] = lies_on(here, seen[k], n, tolerance) ? weights[k] + 1e-3 : 0.0;
    }
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 4; ++k)
        sum += weights[k] * texelFetch(radiance, clamp(base + ivec2(k & 1, k >> 1), ivec2(0), last), 0).rgb;
    return sum / dot(weights, vec4(1.0));
}
#else
vec3 shown_radiance() {
    if (frame.size_px.xy == frame.size_px.zw) return texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb;
    return textureLod(radiance, gl_FragCoord.xy / vec2(frame.size_px.zw), 0.0).rgb;
}
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
