// Paths of one frame: mean radiance per pixel and the surface seen. Of all pixels, or of one in stride x stride.
#include "lib/path.glsl"
#include "lib/camera.glsl"
#include "lib/scatter.glsl"
#include "lib/surface.glsl"

layout(rgba32f, binding = IMAGE_PREVIOUS_RADIANCE) readonly restrict uniform image2D previous_radiance;
layout(r32ui, binding = IMAGE_PREVIOUS_SURFACE) readonly restrict uniform uimage2D previous_surface;
#include "lib/new_pixel.glsl"

layout(location = 0) out vec4 out_radiance;  // rgb; a: image_vox of FirstSurface where asked for, else 1
layout(location = 1) out uint out_surface;   // lib/surface.glsl
#ifdef TRACE_COUNT
layout(location = 2) out vec2 out_counts;    // bounces and steps, means over the paths
#endif

#ifdef TRACE_CLEAR
layout(binding = BINDING_BRICK_CHANGED) uniform usampler3D brick_changed;
uniform uint still_since;  // water in bricks that changed after this version of the world moves
#endif

uniform uint stride;
uniform uint new_pixel_samples;  // in place of each one; 1: the previous frame is not read

layout(std430, binding = 0) buffer RejectedBlock { uint rejected_samples; };

void main() {
    uvec2 pixel = min(uvec2(gl_FragCoord.xy) * stride + stride / 2u, uvec2(frame.size_px.xy) - 1u);
    vec3 sum = vec3(0.0);
    FirstSurface first;
    uint code = SURFACE_CODE_SKY;
#ifdef TRACE_COUNT
    out_counts = vec2(0.0);
#endif
    // From whole numbers: interpolated between corners, the rays of very wide views lose digits near the middle.
    bool scattered = option(OPTION_SCATTER);
    vec2 size = vec2(scattered ? frame.size_px.zw : frame.size_px.xy);
    vec2 center = scattered ? vec2(shown_pixel(ivec2(pixel))) + 0.5 : vec2(pixel) + 0.5;
    vec2 ndc = (2.0 * center - size) / size;
    uint each_frame = frame.counters.z;
    uint count = each_frame;
    for (uint i = 0u; i < count; ++i) {
        if (option(OPTION_LOW_DISCREPANCY) && i < each_frame)
            rng_seed_sequence(pixel, frame.counters.x * each_frame + i, frame.counters.y);
        else
            rng_seed(pixel, frame.counters.x, i, frame.counters.y);
        vec2 at = ndc;
        if (option(OPTION_JITTER)) at += (2.0 * rng_vec2() - 1.0) / size;
        FirstSurface surface;
        vec3 radiance = trace_path(frame.camera_position_vox.xyz, normalize(camera_ray(at)), surface);
        if (i == 0u) {
            first = surface;
            code = surface_code(first.position_vox, first.normal, first.material);
            bool more = new_pixel_samples > 1u;
            if (more && is_new_pixel(code, first.position_vox)) count *= new_pixel_samples;
        }
#ifdef TRACE_COUNT
        out_counts += vec2(path_bounces, steps_walked);
        path_bounces = steps_walked = 0;
#endif
        if (is_finite(radiance))
            sum += radiance;
        else
            atomicAdd(rejected_samples, 1u);
    }
#ifdef TRACE_COUNT
    out_counts /= float(count);
#endif
    out_radiance = vec4(sum / float(count), option(OPTION_IMAGE_DISTANCE) ? first.image_vox : 1.0);
    out_surface = code;
#ifdef TRACE_CLEAR
    if (first.material == MATERIAL_WATER) {
        vec3 within = clamp(first.position_vox - 0.5 * first.normal, vec3(0.0), vec3(frame.world_size_vox.xyz - 1));
        uint stamp = texelFetch(brick_changed, ivec3(within) >> BRICK_SHIFT, 0).r;
        // Stamps wrap: compare by signed difference.
        if (int(stamp - still_since) > 0) out_surface |= SURFACE_MOVES;
    }
#endif
}
