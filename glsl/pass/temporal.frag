// Reverse reprojection: the history of what this pixel shows, from four tested taps of the previous frame, blended
// with the new frame.
#include "lib/camera.glsl"
#include "lib/materials.glsl"
#include "lib/math.glsl"
#include "lib/surface.glsl"

layout(binding = BINDING_BRICK_CHANGED) uniform usampler3D brick_changed;
layout(binding = 4) uniform sampler2D radiance;
layout(binding = 5) uniform sampler2D surface;
layout(binding = 6) uniform sampler2D previous_radiance;  // rgb; a: frames kept
layout(binding = 7) uniform sampler2D previous_surface;

#ifdef HISTORY_MOMENTS
layout(binding = 8) uniform sampler2D previous_moments;
uniform bool has_moments;  // the previous frame wrote some
#endif

uniform uint previous_version;  // of the world, when the previous frame was made

layout(location = 0) out vec4 out_radiance;  // rgb; a: frames kept, this one included
#ifdef HISTORY_MOMENTS
// r: variance of one frame's luminance; g: sum of the squared weights of the frames in the mean, so that r * g is the
// mean's variance; b: frames that r is made of
layout(location = 1) out vec4 out_moments;
#endif

layout(std430, binding = 0) buffer RejectedBlock { uint rejected_samples; };

// History kept where cells changed: short enough to follow, long enough not to flicker. What shines through moving
// water takes many bounces and is noisier by far than the lag that more frames bring.
const float FRAMES_KEPT_NEAR_CHANGE = 3.0;
const float FRAMES_KEPT_IN_MOVING_WATER = 10.0;

bool changed_since(vec3 at_vox) {
    ivec3 cell = clamp(ivec3(floor(at_vox)), ivec3(0), frame.world_size_vox.xyz - 1);
    uint stamp = texelFetch(brick_changed, cell >> BRICK_SHIFT, 0).r;
    // Stamps wrap: compare by signed difference.
    return int(stamp - previous_version) > 0;
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 value = texelFetch(radiance, at, 0).rgb;
    vec4 here = texelFetch(surface, at, 0);
    vec3 n = surface_normal(here.w);
    uint id = surface_material(here.w);

    vec4 history = vec4(0.0);
    float weight_sum = 0.0;
#ifdef HISTORY_MOMENTS
    vec3 moments = vec3(0.0);
#endif
    vec2 ndc;
    if (frame.world_size_vox.w != 0 && previous_ndc(here.xyz, ndc) && all(lessThan(abs(ndc), vec2(1.0)))) {
        vec2 size = vec2(textureSize(previous_radiance, 0));
        vec2 texel = (ndc * 0.5 + 0.5) * size - 0.5;
        // A still camera reprojects onto itself up to rounding; without this, history would creep and blur.
        vec2 nearest = round(texel);
        if (all(lessThan(abs(texel - nearest), vec2(0.01)))) texel = nearest;
        ivec2 base = ivec2(floor(texel));
        vec2 f = texel - vec2(base);
        float tolerance = plane_tolerance(here, frame.camera_position_vox.xyz);
        for (int k = 0; k < 4; ++k) {
            ivec2 tap = base + ivec2(k & 1, k >> 1);
            vec2 w2 = mix(1.0 - f, f, vec2(k & 1, k >> 1));
            float w = w2.x * w2.y;
            if (w <= 0.0 || any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(size)))) continue;
            if (!lies_on(here, texelFetch(previous_surface, tap, 0), n, tolerance)) continue;
            vec4 kept = texelFetch(previous_radiance, tap, 0);
            if (!is_finite(kept.rgb) || !is_finite(kept.a)) {
                atomicAdd(rejected_samples, 1u);
                continue;
            }
            history += w * kept;
#ifdef HISTORY_MOMENTS
            if (has_moments) moments += w * texelFetch(previous_moments, tap, 0).rgb;
#endif
            weight_sum += w;
        }
    }
    float count = 0.0;
    if (weight_sum > 0.01) {
        history /= weight_sum;
        count = history.a;
        if (id != SURFACE_SKY && changed_since(here.xyz - 0.5 * n))
            count = min(count, id == MATERIAL_WATER ? FRAMES_KEPT_IN_MOVING_WATER : FRAMES_KEPT_NEAR_CHANGE);
        count = min(count, frame.history.y - 1.0);
    }
#ifdef HISTORY_BLEND
    float alpha = count > 0.0 ? frame.history.x : 1.0;
#else
    float alpha = 1.0 / (count + 1.0);
#endif
    out_radiance = vec4(count > 0.0 ? mix(history.rgb, value, alpha) : value, count + 1.0);
#ifdef HISTORY_MOMENTS
    moments = count > 0.0 ? moments / weight_sum : vec3(0.0);
    if (!is_finite(moments)) moments = vec3(0.0);
    if (count > 0.0) {
        // A history from before the moments were kept: the squares of its weights as they are in the long run.
#ifdef HISTORY_BLEND
        float settled = alpha / (2.0 - alpha);
#else
        float settled = 1.0 / count;
#endif
        if (moments.g == 0.0) moments.g = settled;
        // The expected square of this is the variance of a frame, times 1 and that of the mean it is compared with.
        float deviation = luminance(value) - luminance(history.rgb);
        float frame_variance = min(deviation * deviation, 1e30) / (1.0 + moments.g);
        float share = 1.0 / (min(moments.b, frame.history.y - 1.0) + 1.0);
        out_moments = vec4(mix(moments.r, frame_variance, share),
                           (1.0 - alpha) * (1.0 - alpha) * moments.g + alpha * alpha, moments.b + 1.0, 0.0);
    } else {
        out_moments = vec4(0.0, 1.0, 0.0, 0.0);
    }
#endif
}
