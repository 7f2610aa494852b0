// Edges without more rays: the surface at each of a few sub-samples of a pixel is looked for among those that the pixel
// and its neighbours show, and the sub-sample has their light.
#include "lib/math.glsl"
#include "lib/face_on_ray.glsl"

layout(rgba32f, binding = IMAGE_RADIANCE) readonly restrict uniform image2D radiance;
layout(r32ui, binding = IMAGE_SURFACE) readonly restrict uniform uimage2D surface;  // lib/surface.glsl

// Sub-samples of a pixel, n, and their lattice: the i-th of n columns is taken in the row (n + 1) fract((i + 1) y) - 1.
uniform vec2 pattern;  // n, y

layout(location = 0) out vec4 out_radiance;

// From the centre of the pixel, in pixels.
vec2 sub_sample(float i) {
    float row = (pattern.x + 1.0) * fract((i + 1.0) * pattern.y) - 1.0;
    return (vec2(i, row) + 0.5) / pattern.x - 0.5;
}

// Surfaces that a sub-sample is tested for: the pixel's, and those of its neighbours along x and y on that side.
const int TESTS = 3;
// Distances along a ray within this factor of each other are of one surface, or of an edge between two.
const float SAME_DISTANCE = 1.0001;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = imageSize(surface) - 1;
    vec3 eye = frame.camera_position_vox.xyz;
    uint here = imageLoad(surface, pixel).r;
    vec3 own = imageLoad(radiance, pixel).rgb;
    // Which of the neighbours -x, +x, -y, +y show another surface.
    bvec4 differs = bvec4(!lies_on(here, imageLoad(surface, ivec2(max(pixel.x - 1, 0), pixel.y)).r),
                          !lies_on(here, imageLoad(surface, ivec2(min(pixel.x + 1, last.x), pixel.y)).r),
                          !lies_on(here, imageLoad(surface, ivec2(pixel.x, max(pixel.y - 1, 0))).r),
                          !lies_on(here, imageLoad(surface, ivec2(pixel.x, min(pixel.y + 1, last.y))).r));

    // The tests of all sub-samples that have another surface beside them, bit TESTS i + k.
    uint left = 0u;
    float unmixed = 0.0;
    for (float i = 0.0; i < pattern.x; ++i) {
        vec2 offset = sub_sample(i);
        uint beside = (offset.x < 0.0 ? differs.x : differs.y) ? 2u : 0u;
        beside |= (offset.y < 0.0 ? differs.z : differs.w) ? 4u : 0u;
        left |= (beside != 0u ? beside | 1u : 0u) << (TESTS * int(i));
        unmixed += beside != 0u ? 0.0 : 1.0;
    }
    vec3 sum = unmixed * own;
    float own_luminance = min(luminance(own), 1e30) + 1e-20;
    vec4 found = vec4(0.0);  // light times weight of the nearest surface so far, weight
    vec4 any = vec4(0.0);    // likewise of all that were tested, less of what is brighter than the pixel
    float nearest = TRAVERSAL_NEVER;
    // One test a round: llvmpipe runs as many rounds as the pixel that has most needs.
    while (left != 0u) {
        int bit = findLSB(left);
        int i = (bit * 11) >> 5;
        int k = bit - TESTS * i;
        left &= left - 1u;
        vec2 offset = sub_sample(float(i));
        ivec2 tap = pixel;
        if (k == 1) tap.x += offset.x < 0.0 ? -1 : 1;
        if (k == 2) tap.y += offset.y < 0.0 ? -1 : 1;
        float weight = k == 1 ? abs(offset.x) : k == 2 ? abs(offset.y) : (1.0 - abs(offset.x)) * (1.0 - abs(offset.y));
        vec3 shown = imageLoad(radiance, tap).rgb;
        vec4 light = weight * vec4(shown, 1.0);
        vec3 dir = camera_ray(2.0 * (gl_FragCoord.xy + offset) / vec2(last + 1) - 1.0);
        float t = distance_to(imageLoad(surface, tap).r, eye, dir);
        if (t * SAME_DISTANCE < nearest) {
            nearest = t;
            found = vec4(0.0);
        }
        if (t < TRAVERSAL_NEVER && t <= nearest * SAME_DISTANCE) found += light;
        any += light / (min(luminance(shown), 1e30) + own_luminance);
        // The last of this sub-sample. Where none of the surfaces is met, something else or the sky is seen there; to
        // take the sky wherever it is a neighbour drew bright rims (error of `lake` .022 in place of .018).
        if ((left & (7u << (TESTS * i))) == 0u) {
            vec4 mean = found.a > 0.0 ? found : any;
            sum += mean.rgb / mean.a;
            found = any = vec4(0.0);
            nearest = TRAVERSAL_NEVER;
        }
    }
    out_radiance = vec4(unmixed == pattern.x ? own : sum / pattern.x, 1.0);
}
