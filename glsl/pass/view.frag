// What the renderer knows of each pixel besides its radiance, in false colours or as it is (VIEW_RAW, -1: nothing).
// SHOWN_VIEW: one of shared/views.h; VIEW_EXACT: history and variance come from exact mode's sums; VIEW_SINGLE: there
// is no history.
#include "shared/views.h"
#include "lib/camera.glsl"
#include "lib/materials.glsl"
#include "lib/math.glsl"
#include "lib/surface.glsl"

layout(binding = 4) uniform usampler2D surface;
layout(binding = 5) uniform sampler2D counts;      // of the last frame
layout(binding = 6) uniform sampler2D history;     // a: frames kept, exact: frames lost
layout(binding = 7) uniform sampler2D moments;     // as temporal.frag writes them; exact: sums
layout(binding = 8) uniform sampler2D correction;  // exact: of the sums

layout(location = 0) out vec4 out_picture;

float frames_kept(ivec2 at) {
#if defined(VIEW_SINGLE)
    return 1.0;
#elif defined(VIEW_EXACT)
    return float(frame.counters.w + 1u - uint(texelFetch(history, at, 0).a));
#else
    return texelFetch(history, at, 0).a;
#endif
}

// Of the mean's luminance, estimated from the spread of the frames it is made of.
float variance_of_mean(ivec2 at) {
#if defined(VIEW_SINGLE)
    return VIEW_NOTHING;
#elif defined(VIEW_EXACT)
    float n = frames_kept(at);
    float deviations = texelFetch(moments, at, 0).a + texelFetch(correction, at, 0).a;
    return n > 1.0 ? deviations / n / (n - 1.0) : VIEW_NOTHING;
#else
    vec3 m = texelFetch(moments, at, 0).rgb;
    return m.b > 0.0 ? m.r * m.g : VIEW_NOTHING;
#endif
}

vec3 value_at(ivec2 at) {
#if SHOWN_VIEW == VIEW_ALBEDO
    uint id = surface_material(texelFetch(surface, at, 0).r);
    return id == SURFACE_SKY ? vec3(0.0) : materials[id].base_roughness.rgb;
#elif SHOWN_VIEW == VIEW_NORMAL
    return surface_normal(texelFetch(surface, at, 0).r);
#elif SHOWN_VIEW == VIEW_DEPTH
    uint here = texelFetch(surface, at, 0).r;
    vec3 eye = frame.camera_position_vox.xyz;
    // Of the pixel's middle, also where the ray that found the plane was another.
    vec3 dir = normalize(pixel_ray(vec2(at) + 0.5, vec2(textureSize(surface, 0))));
    return vec3(here == SURFACE_CODE_SKY ? VIEW_NOTHING : distance(surface_point(here, eye, dir), eye));
#elif SHOWN_VIEW == VIEW_MATERIAL
    return vec3(surface_material(texelFetch(surface, at, 0).r));
#elif SHOWN_VIEW == VIEW_BOUNCES
    return texelFetch(counts, at, 0).rrr;
#elif SHOWN_VIEW == VIEW_STEPS
    return texelFetch(counts, at, 0).ggg;
#elif SHOWN_VIEW == VIEW_HISTORY
    return vec3(frames_kept(at));
#else
    return vec3(variance_of_mean(at));
#endif
}

// sRGB codes; black for the sky and where there is no value.
vec3 color_of(vec3 value) {
#if SHOWN_VIEW == VIEW_ALBEDO
    return srgb_from_linear(clamp(value, 0.0, 1.0));
#elif SHOWN_VIEW == VIEW_NORMAL
    return value == vec3(0.0) ? value : 0.5 * value + 0.5;
#elif SHOWN_VIEW == VIEW_MATERIAL
    return uint(value.x) == SURFACE_SKY ? vec3(0.0) : view_material_color(uint(value.x));
#else
    float offset = view_offset(SHOWN_VIEW);
    float low = view_low(SHOWN_VIEW) + offset;
    float high = view_high(SHOWN_VIEW) + offset;
    if (value.x == VIEW_NOTHING) return vec3(0.0);
    return clamp(view_color(clamp(log(max(value.x + offset, low) / low) / log(high / low), 0.0, 1.0)), 0.0, 1.0);
#endif
}

void main() {
#if SHOWN_VIEW == VIEW_BOUNCES || SHOWN_VIEW == VIEW_STEPS
    ivec2 size = textureSize(counts, 0);
#else
    ivec2 size = textureSize(surface, 0);
#endif
    ivec2 at = ivec2(gl_FragCoord.xy * vec2(size) / vec2(frame.size_px.zw));
    vec3 value = value_at(min(at, size - 1));
#ifdef VIEW_RAW
    out_picture = vec4(value, 1.0);
#else
    out_picture = vec4(color_of(value), 1.0);
#endif
}
