// Reverse reprojection: the history of what this pixel shows, from four tested taps of the previous frame, blended
// with the new frame. HISTORY_UPSAMPLE: fewer pixels are traced than shown; a pixel that is not keeps its history as it
// is, or takes the light of traced ones that show its surface.
#include "lib/camera.glsl"
#include "lib/materials.glsl"
#include "lib/math.glsl"
#include "lib/surface.glsl"

layout(r32ui, binding = IMAGE_BRICK_CHANGED) readonly restrict uniform uimage3D brick_changed;
layout(rgba32f, binding = IMAGE_RADIANCE) readonly restrict uniform image2D radiance;
layout(r32ui, binding = IMAGE_SURFACE) readonly restrict uniform uimage2D surface;
// rgb; a: frames kept
layout(rgba32f, binding = IMAGE_PREVIOUS_RADIANCE) readonly restrict uniform image2D previous_radiance;
layout(r32ui, binding = IMAGE_PREVIOUS_SURFACE) readonly restrict uniform uimage2D previous_surface;

#ifdef HISTORY_UPSAMPLE
layout(location = 1) out uint out_surface;
#endif
#ifdef HISTORY_MOMENTS
layout(binding = 8) uniform sampler2D previous_moments;
uniform bool has_moments;  // the previous frame wrote some
#endif

uniform float new_pixel_samples;  // a new pixel's this frame, in place of each one
uniform uint previous_version;  // of the world, when the previous frame was made

#ifndef HISTORY_BLEND
layout(binding = 9) uniform sampler2D retraced;         // the previous frame's paths in this world, some of them
layout(binding = 10) uniform sampler2D traced_before;   // the previous frame's light as traced
uniform int retrace_stride;  // of one traced pixel in stride x stride; 0: of none
#endif

layout(location = 0) out vec4 out_radiance;  // rgb; a: frames kept, this one included
#ifdef HISTORY_MOMENTS
// r: variance of one frame's luminance; g: sum of the squared weights of the frames in the mean, so that r * g is the
// mean's variance; b: frames that r is made of
#ifdef HISTORY_UPSAMPLE
layout(location = 2) out vec4 out_moments;
#else
layout(location = 1) out vec4 out_moments;
#endif
#endif

layout(std430, binding = 0) buffer RejectedBlock { uint rejected_samples; };

// History kept where cells changed: short enough to follow, long enough not to flicker. With ten frames of moving water
// its error was twice as large.
const float FRAMES_KEPT_NEAR_CHANGE = 3.0;

// A mean of four neighbours in every frame in which the eye moves or turns blurs the shadows on a surface: `quality` of
// `waterfall` .082, so .074. Four more along each axis (Catmull-Rom) gained 2 % there, and lost 12 % in `cave`.
const float SAMPLES_KEPT_IN_FLIGHT = 12.0;
// Beyond this angle (rad) in one frame still fewer: what was seen from there was seen otherwise.
const float ANGLE_OF_A_JUMP = 0.05;

#ifndef HISTORY_BLEND
// Frames that may be kept of what the previous frame showed at `ndc`: their bias by the share d of the light that the
// change of the world took or gave outweighs their noise beyond 1 / d^2. Without `asked` it means nothing.
float frames_kept_of_light(vec2 ndc, bool asked) {
    ivec2 last_traced = textureSize(traced_before, 0) - 1;
    ivec2 last = textureSize(retraced, 0) - 1;
    float stride = float(max(retrace_stride, 1));
    const float reach = float(RETRACE_REACH_PX);
    float center = float(retrace_stride / 2) + 0.5;  // of a cell's pixel, in the first cell
    vec2 place = (ndc * 0.5 + 0.5) * vec2(last_traced + 1) - center;
    ivec2 first = ivec2(floor((place - reach) / stride)) + 1;
    float difference = 0.0;
    float sum = 1e-20;
    // Where no lane asks, llvmpipe pays for one round.
    int side = asked ? 2 * int(RETRACE_REACH_PX) / max(retrace_stride, 1) : 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            ivec2 cell = first + ivec2(x, y);
            vec2 w = 1.0 - min(abs(vec2(cell) * stride - place) / reach, 1.0);
            cell = clamp(cell, ivec2(0), last);
            ivec2 pixel = min(cell * retrace_stride + retrace_stride / 2, last_traced);
            float now = luminance(texelFetch(retraced, cell, 0).rgb);
            float before = luminance(texelFetch(traced_before, pixel, 0).rgb);
            difference += w.x * w.y * (now - before) * (now - before);
            float light = max(now, before);
            sum += w.x * w.y * light * light;
        }
    float share_squared = difference / sum;
    return is_finite(share_squared) ? max(0.1, 1.0 / max(share_squared, 1e-6) - 0.9) : 0.1;
}
#endif

// What is seen in or through a smooth surface glides over it as the eye moves. History follows the brighter of what the
// surface mirrors and what lies behind it, and may lag behind the other by this many pixels over its share of the light.
const float IMAGE_LAG_PX = 3.0;
// By this share of its way history fails to follow, for paths tell of the distance roughly.
const float IMAGE_MISSED = 0.1;
// Likewise for what lies under water, whose image is no point, as the eye moves across its line of sight and along.
const float BED_MISSED_ACROSS = 0.2;
const float BED_MISSED_ALONG = 0.6;

bool shows_an_image(uint id) {
    return id != SURFACE_SKY && (transmits(id) || materials[id].emission_metallic.w > 0.5);
}

// Where no path told, the bed seems to lie so deep under a level surface. Lakes are that deep or less near their shores.
const float BED_DEPTH_VOX = 9.0;
const float MIRRORED_AT_NORMAL = 0.03;  // by water, by glass about

bool changed_since(vec3 at_vox) {
    ivec3 cell = clamp(ivec3(floor(at_vox)), ivec3(0), frame.world_size_vox.xyz - 1);
    uint stamp = imageLoad(brick_changed, cell >> BRICK_SHIFT).r;
    // Stamps wrap: compare by signed difference.
    return int(stamp - previous_version) > 0;
}

#include "lib/new_pixel.glsl"
#include "lib/traced.glsl"

// How far behind the surface that the pixel shows its image seems to lie, what it mirrors or what is behind it; 0 where
// no path told.
float image_behind(Traced traced, bool mirrored) {
    float count = 0.0;
    float inverse = 1e-20;
    for (int k = 0; k < 4; ++k) {
        float behind = imageLoad(radiance, traced.taps[k]).a * (mirrored ? -1.0 : 1.0);
        bool tells = behind > 0.0 && lies_on(traced.surface, imageLoad(surface, traced.taps[k]).r);
        count += tells ? 1.0 : 0.0;
        inverse += tells ? 1.0 / behind : 0.0;
    }
    return count / inverse;
}

// How much of the eye's way across `dir` lies in the plane of `dir` and n, as a share of its square.
float share_along(vec3 dir, vec3 n) {
    vec3 way = frame.camera_position_vox.xyz - frame.previous_position_vox.xyz;
    way -= dot(way, dir) * dir;
    vec3 along = n - dot(n, dir) * dir;
    float both = dot(way, along);
    return both * both / max(dot(way, way) * dot(along, along), 1e-20);
}

// Where to look for the history of a surface that shows an image, and how many frames of it may be kept: what lies far
// behind glides by the angle that the eye's way spans at the surface, what lies near by less.
struct Image {
    vec3 point_vox;
    float frames_kept;
};
Image image_in(Traced traced, vec3 at_vox, float height_px) {
    vec3 n = surface_normal(traced.surface);
    uint id = surface_material(traced.surface);
    vec3 to_surface = at_vox - frame.camera_position_vox.xyz;
    float away = length(to_surface);
    vec3 dir = to_surface / max(away, 1e-6);
    vec3 dir_before = normalize(at_vox - frame.previous_position_vox.xyz);
    float pixels = distance(dir, dir_before) * 0.5 * height_px / length(frame.camera_up.xyz);
    float ior = materials[MATERIAL_WATER].absorption_ior.w;
    float cosine = abs(dot(dir, n));
    // From below the cosine in air counts; none is left where all is mirrored.
    bool from_below = id == MATERIAL_WATER && n.y < -0.5;
    if (from_below) cosine = sqrt(max(0.0, 1.0 - ior * ior * (1.0 - cosine * cosine)));
    float grazing = 1.0 - cosine;
    float squared = grazing * grazing;
    float mirrored =
        transmits(id) ? MIRRORED_AT_NORMAL + (1.0 - MIRRORED_AT_NORMAL) * squared * squared * grazing : 1.0;
    bool mirror = mirrored > 0.5;
    bool over_a_bed = id == MATERIAL_WATER && n.y > 0.5;
    float beyond = over_a_bed ? BED_DEPTH_VOX / (away + BED_DEPTH_VOX) : 1.0;
    float glides = mix(beyond, 1.0, mirrored);
    float behind = is_moving(traced.surface) ? 0.0 : image_behind(traced, mirror);
    if (behind > 0.0) {
        float missed = IMAGE_MISSED;
        if (over_a_bed && !mirror) {
            // Paths tell where a point lies for an eye that moves across (the sagittal image); along, it lies nearer.
            float along = share_along(dir, n);
            float squared_cosine = cosine * cosine;
            behind *= mix(1.0, squared_cosine / max(1.0 - (1.0 - squared_cosine) / (ior * ior), 0.05), along);
            missed = mix(BED_MISSED_ACROSS, BED_MISSED_ALONG, along);
        }
        float follows = behind / (away + behind);
        glides = missed * follows + (mirror ? (1.0 - mirrored) * abs(follows - beyond) : mirrored * (1.0 - follows));
    } else if (over_a_bed && !is_moving(traced.surface)) {
        behind = mirror ? IMAGE_FAR_VOX : BED_DEPTH_VOX;
    }
    return Image(at_vox + behind * dir, IMAGE_LAG_PX / max(pixels * glides, 1e-6));
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 size = vec2(imageSize(previous_radiance));
    vec3 eye = frame.camera_position_vox.xyz;
    vec3 dir = normalize(pixel_ray(gl_FragCoord.xy, size));
    Traced traced = traced_around(at, dir);
    uint here = traced.surface;
    vec3 point = surface_point(here, eye, dir);
    uint id = surface_material(here);

    vec4 history = vec4(0.0);
    float weight_sum = 0.0;
    uint rejected = 0u;
#ifdef HISTORY_MOMENTS
    vec3 moments = vec3(0.0);
#endif
    Image image = Image(point, 1e6);
    // To turn the eye moves no image.
    bool eye_moved = eye != frame.previous_position_vox.xyz;
    for (bool once = eye_moved && shows_an_image(id); once; once = false)
        image = image_in(traced, point, size.y);
    vec2 ndc;
    bool resampled = false;
    if (frame.world_size_vox.w != 0 && previous_ndc(image.point_vox, ndc) && all(lessThan(abs(ndc), vec2(1.0)))) {
        vec2 texel = (ndc * 0.5 + 0.5) * size - 0.5;
        // A still camera reprojects onto itself up to rounding; without this, history would creep and blur.
        vec2 nearest = round(texel);
        if (all(lessThan(abs(texel - nearest), vec2(0.01)))) texel = nearest;
        ivec2 base = ivec2(floor(texel));
        vec2 f = texel - vec2(base);
        resampled = f != vec2(0.0);
        int taps = resampled ? 4 : 1;
        for (int k = 0; k < taps; ++k) {
            ivec2 tap = base + ivec2(k & 1, k >> 1);
            vec2 w2 = mix(1.0 - f, f, vec2(k & 1, k >> 1));
            float w = w2.x * w2.y;
            if (w <= 0.0 || any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(size)))) continue;
            if (!lies_on(here, imageLoad(previous_surface, tap).r)) continue;
            vec4 kept = imageLoad(previous_radiance, tap);
            if (!is_finite(kept.rgb) || !is_finite(kept.a)) {
                ++rejected;
                continue;
            }
            history += w * kept;
#ifdef HISTORY_MOMENTS
            if (has_moments) moments += w * texelFetch(previous_moments, tap, 0).rgb;
#endif
            weight_sum += w;
        }
    }
    for (bool once = rejected > 0u; once; once = false) atomicAdd(rejected_samples, rejected);
    float count = 0.0;
    if (weight_sum > 0.01) {
        history /= weight_sum;
        count = history.a;
        if (id != SURFACE_SKY && changed_since(point - 0.5 * surface_normal(here)))
            count = min(count, SAMPLES_A_FRAME * FRAMES_KEPT_NEAR_CHANGE);
        count = min(count, SAMPLES_A_FRAME * image.frames_kept);
        count = min(count, frame.history.y - 1.0);
        vec3 way = eye - frame.previous_position_vox.xyz;
        vec3 to_surface = point - eye;
        // The tangent of the angle between the directions from there and from here.
        float turned = length(cross(way, to_surface)) / max(dot(to_surface + way, to_surface), 1e-6);
        if (resampled) count = min(count, SAMPLES_KEPT_IN_FLIGHT / max(1.0, turned / ANGLE_OF_A_JUMP));
#ifndef HISTORY_BLEND
        bool asked = retrace_stride > 0 && !is_moving(here);
        float kept_of_light = frames_kept_of_light(ndc, asked);
        if (asked) count = min(count, SAMPLES_A_FRAME * kept_of_light);
#endif
    }
    float worth = new_pixel_samples > 1.0 && traced.own && is_new_pixel(here, point) ? new_pixel_samples : 1.0;
#ifdef HISTORY_UPSAMPLE
    if (!traced.own) worth = count < SAMPLES_WITHOUT_NEIGHBOURS ? (traced.met ? NEIGHBOURS_WORTH : STRANGERS_WORTH) : 0.0;
    out_surface = here;
#endif
    vec3 value = history.rgb;
    for (bool once = worth > 0.0 || count == 0.0; once; once = false) value = light_of(traced);
#ifdef HISTORY_BLEND
    float alpha = count > 0.0 ? min(1.0, frame.history.x * worth) : 1.0;
#else
    float alpha = count > 0.0 ? worth / (count + worth) : 1.0;
#endif
    out_radiance = vec4(count > 0.0 ? mix(history.rgb, value, alpha) : value, count + worth);
#ifdef HISTORY_MOMENTS
    moments = count > 0.0 ? moments / weight_sum : vec3(0.0);
    if (!is_finite(moments)) moments = vec3(0.0);
    if (count == 0.0) {
        out_moments = vec4(0.0, 1.0, 0.0, 0.0);
    } else if (!traced.own) {
        out_moments = vec4(moments, 0.0);
    } else {
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
    }
#endif
}
