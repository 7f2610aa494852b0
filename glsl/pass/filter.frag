// A blur against noise. FILTER_GAUSSIAN: one direction of a separable one of 5 taps, over everything. Otherwise one
// pass of taps around the pixel, within one surface of one material (stairs count as one where a pixel has next to no
// history); fewer and weaker the more frames a pixel has. FILTER_MOVING: water may move, and has more of them.
#include "shared/bindings.h"
#include "lib/camera.glsl"
#include "lib/materials.glsl"
#include "lib/math.glsl"
#include "lib/surface.glsl"

layout(rgba32f, binding = IMAGE_RADIANCE) readonly restrict uniform image2D radiance;  // rgb; a: frames kept
#ifndef FILTER_GAUSSIAN
layout(r32ui, binding = IMAGE_SURFACE) readonly restrict uniform uimage2D surface;
#endif

uniform ivec2 step_px;  // distance of neighbouring taps; Gaussian: and direction

layout(location = 0) out vec4 out_radiance;

#ifdef FILTER_GAUSSIAN
const float KERNEL[3] = float[3](6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);  // binomial
#else
// Taps in three rings of four: sides, corners, sides two steps away. Their places along x and y, plus 2, four bits a tap.
const uint PLACES_X[2] = uint[2](0x31132123u, 0x2024u);
const uint PLACES_Y[2] = uint[2](0x11331232u, 0x0242u);
const float RING_WEIGHT[3] = float[3](0.9, 0.7, 0.4);  // the pixel's own is 1
// From so many frames on the rings around the first no longer pay.
const float FRAMES_OF_CORNERS = 4.0;
const float FRAMES_OF_FAR_SIDES = 3.0;

// With fewer frames (where cells change, always) stairs count as one surface: faces of one material and direction up to
// two voxels apart.
const float FRAMES_OF_STAIRS = 3.0;
const int STAIRS_PLANES = 32;

// With fewer frames the brightness of a pixel behind water says nothing yet.
const float FRAMES_OF_NOISE = 12.0;

// To here all neighbours count in full; then less, for there is less noise to trade for sharpness. To tell by each
// pixel's variance in place of its frames gained nothing: of so few frames it is as noisy as the light.
const float NOISY_FRAMES = 2.0;
// Chance decides what a path through water or glass sees: it takes so many times the frames.
const float CLEAR_IS_NOISIER = 1.5;
// Wider passes are for pixels that have next to no history.
const float WIDE_FRAMES = 8.0;

#ifdef FILTER_MOVING
// Moving water has the light of a few paths, a dozen interfaces long: rings twice and four times as wide as well.
const int MOVING_TAPS = 36;

vec3 point_at(uint code, ivec2 pixel) {
    // As long as it is: a length of 1 would give the same point.
    vec3 ray = pixel_ray(vec2(pixel) + 0.5, vec2(imageSize(surface)));
    return surface_point(code, frame.camera_position_vox.xyz, ray);
}
#endif

int taps_at(float frames) { return frames < FRAMES_OF_FAR_SIDES ? 12 : frames < FRAMES_OF_CORNERS ? 8 : 4; }

ivec2 place_of(int tap) {
    uint shift = 4u * (uint(tap) & 7u);
    return ivec2((PLACES_X[tap >> 3] >> shift) & 15u, (PLACES_Y[tap >> 3] >> shift) & 15u) - 2;
}
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 last = imageSize(radiance) - 1;
    vec4 center = imageLoad(radiance, at);
#ifdef FILTER_GAUSSIAN
    vec3 sum = center.rgb * KERNEL[0];
    for (int i = -2; i <= 2; ++i) {
        if (i != 0) sum += imageLoad(radiance, clamp(at + i * step_px, ivec2(0), last)).rgb * KERNEL[abs(i)];
    }
    out_radiance = vec4(sum, center.a);
#else
    uint here = imageLoad(surface, at).r;
    bool is_clear = transmits(surface_material(here));
    float frames = center.a / (is_clear ? CLEAR_IS_NOISIER : 1.0);
    bool wide = step_px.x > 1;
    float strength = wide ? max(0.0, 1.0 - center.a / WIDE_FRAMES) : min(1.0, NOISY_FRAMES / frames);
    // Behind a clear surface lies a picture of its own: keep its edges by brightness, once there is more to see than
    // noise.
    bool keeps_edges = is_clear && center.a > FRAMES_OF_NOISE;
    float center_luminance = luminance(center.rgb);
    float fall_off = keeps_edges ? 1.0 / (0.1 + 0.25 * center_luminance) : 0.0;
    int stairs = center.a < FRAMES_OF_STAIRS ? STAIRS_PLANES : -1;
    vec3 sum = center.rgb;
    float weight_sum = 1.0;
    int taps = here == SURFACE_CODE_SKY || strength == 0.0 ? 0 : taps_at(frames);
#ifdef FILTER_MOVING
    bool moving = is_moving(here) && strength > 0.0;
    if (moving) taps = MOVING_TAPS;
    vec3 point = point_at(here, at);
#endif
    for (int k = 0; k < taps; ++k) {
        int wider = k / 12;
        int i = k - 12 * wider;
        ivec2 tap = at + (step_px << wider) * place_of(i);
        // At the picture's edge a tap may meet a pixel twice: no harm.
        tap = clamp(tap, ivec2(0), last);
        uint there = imageLoad(surface, tap).r;
        bool step_of_stairs = on_parallel_planes(here, there) && planes_apart(here, there) <= stairs;
        bool meets = lies_on(here, there);
#ifdef FILTER_MOVING
        // Its taps reach far: what moves is to be near.
        bool near = all(lessThan(abs(point_at(there, tap) - point), vec3(MOVING_TOLERANCE_VOX)));
        meets = meets && (near || !is_moving(here & there));
#endif
        meets = meets || step_of_stairs;
        vec3 value = meets ? imageLoad(radiance, tap).rgb : vec3(0.0);
        float w = strength * RING_WEIGHT[i >> 2] * exp(-abs(luminance(value) - center_luminance) * fall_off);
        if (!meets) w = 0.0;
        sum += w * value;
        weight_sum += w;
    }
    out_radiance = vec4(sum / weight_sum, center.a);
#endif
}
