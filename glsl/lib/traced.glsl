// What this frame traced for a shown pixel: its surface and light; of neighbours, where fewer pixels are traced than
// shown (HISTORY_UPSAMPLE). Reads the images `radiance`, `surface` and `previous_surface` of the pass that includes it.
#include "lib/camera.glsl"
#include "lib/surface.glsl"
#ifdef HISTORY_UPSAMPLE
#include "lib/face_on_ray.glsl"
#include "lib/scatter.glsl"
#endif

// The traced pixels that this frame has for a shown one.
struct Traced {
    uint surface;    // of the shown pixel
    ivec2 taps[4];   // around it or beside it
    vec4 weights;    // of their light; all of it where one of them was traced for this pixel
    bool own;        // that is so
    bool met;        // some of them show its surface
};

#ifdef HISTORY_UPSAMPLE
#define SAMPLES_A_FRAME (float(frame.size_px.x * frame.size_px.y) / float(frame.size_px.z * frame.size_px.w))

// History of so many samples is worth more than this frame's light of neighbours (with 4, after a jump of the eye the
// error took two frames more to fall to 1.5 times that in the long run).
const float SAMPLES_WITHOUT_NEIGHBOURS = 8.0;
// What the light of neighbours counts for, in samples: of the same surface, and of others where there is none.
const float NEIGHBOURS_WORTH = 0.25;
const float STRANGERS_WORTH = 1e-4;

bool is_lamp(uint face) { return face != SURFACE_CODE_SKY && emits(surface_material(face)); }

// The nearest surface along the ray from the eye towards `dir` among those that are asked for, a bit each: of the four
// traced pixels from `base` on, then of the last frame's from `corner` on. Where it meets none of them, the sky if that
// is among them, or else the first that is no lamp.
uint surface_along(vec3 dir, uint asked, ivec2 base, ivec2 corner) {
    ivec2 last = frame.size_px.xy - 1;
    ivec2 last_shown = frame.size_px.zw - 1;
    vec3 eye = frame.camera_position_vox.xyz;
    uint nearest = SURFACE_CODE_SKY;
    float t = 1.1 * TRAVERSAL_NEVER;
    // One test a round: llvmpipe runs as many rounds as the pixel that has most needs.
    while (asked != 0u) {
        int k = findLSB(asked);
        asked &= asked - 1u;
        ivec2 place = ivec2(k & 1, (k >> 1) & 1);
        uint face = k < 4 ? imageLoad(surface, clamp(base + place, ivec2(0), last)).r
                          : imageLoad(previous_surface, clamp(corner + place, ivec2(0), last_shown)).r;
        float t_k = distance_to(face, eye, dir);
        bool none_met = t_k == t && t == TRAVERSAL_NEVER;
        if (t_k < t || (none_met && (face == SURFACE_CODE_SKY || is_lamp(nearest)))) {
            t = t_k;
            nearest = face;
        }
    }
    return nearest;
}

// dir: of the shown pixel's ray.
Traced traced_around(ivec2 at, vec3 dir) {
    ivec2 last = frame.size_px.xy - 1;
    vec2 cell = vec2(frame.size_px.zw) / vec2(frame.size_px.xy);
    // The traced pixel whose cell this is may stand for a pixel on either side.
    ivec2 home = min(ivec2((vec2(at) + 0.5) / cell), last);
    ivec2 base = home - ivec2(greaterThan(shown_pixel(home), at));
    Traced traced;
    traced.met = true;
    uint seen[4];
    vec4 own = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
        traced.taps[k] = clamp(base + ivec2(k & 1, k >> 1), ivec2(0), last);
        ivec2 away = shown_pixel(traced.taps[k]) - at;
        vec2 near = max(vec2(0.0), 1.0 - abs(vec2(away)) / cell);
        traced.weights[k] = near.x * near.y + 1e-3;
        seen[k] = imageLoad(surface, traced.taps[k]).r;
        own[k] = float(away == ivec2(0));
        if (away == ivec2(0)) traced.surface = seen[k];
    }
    traced.own = dot(own, own) > 0.0;
    if (traced.own) {
        traced.weights = own / dot(own, own);  // the last tap may be there twice
        return traced;
    }
    vec2 size = vec2(frame.size_px.zw);
    vec3 eye = frame.camera_position_vox.xyz;
    traced.surface = seen[0];
    vec3 point = surface_point(seen[0], eye, dir);
    uint others = 0u;
    for (int k = 1; k < 4; ++k) others |= lies_on(seen[0], seen[k]) ? 0u : 1u << k;
    bool search = others != 0u;
    // What is thinner than the gaps between traced pixels was seen when its turn came.
    vec2 before;
    bool was_seen = frame.world_size_vox.w != 0 && previous_ndc(point, before) &&
                    all(lessThan(abs(before), vec2(1.0)));
    vec2 at_before = (before * 0.5 + 0.5) * size;
    if (was_seen && !search)
        search = !lies_on(seen[0], imageLoad(previous_surface, ivec2(at_before)).r);
    // A loop that runs at most once: llvmpipe runs the body of a branch for lanes that do not take it.
    for (bool once = search; once; once = false) {
        bool crept = any(greaterThan(abs(fract(at_before) - 0.5), vec2(0.01)));
        uint before_too = !was_seen ? 0u : crept ? 0xf0u : 0x10u;
        // What lies on one surface of water need not lie in one plane.
        uint taps = surface_material(seen[0]) == MATERIAL_WATER ? 15u : 1u | others;
        traced.surface = surface_along(dir, taps | before_too, base, ivec2(floor(at_before - 0.49)));
        for (int k = 0; k < 4; ++k)
            if (!lies_on(traced.surface, seen[k])) traced.weights[k] *= 1e-6;
        traced.met = dot(traced.weights, vec4(1.0)) > 1e-4;
    }
    traced.weights /= dot(traced.weights, vec4(1.0));
    return traced;
}

vec3 light_of(Traced traced) {
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
        vec3 light = imageLoad(radiance, traced.taps[k]).rgb;
        float w = traced.weights[k] * (traced.met ? 1.0 : weight_among_strangers(light));
        sum += w * vec4(light, 1.0);
    }
    return sum.rgb / sum.a;
}
#else
Traced traced_around(ivec2 at, vec3 dir) {
    ivec2 beside = min(at + 1, frame.size_px.xy - 1);
    ivec2 taps[4] = ivec2[4](at, ivec2(beside.x, at.y), ivec2(at.x, beside.y), max(at - 1, ivec2(0)));
    return Traced(imageLoad(surface, at).r, taps, vec4(1.0, 0.0, 0.0, 0.0), true, true);
}
vec3 light_of(Traced traced) { return imageLoad(radiance, traced.taps[0]).rgb; }
#define SAMPLES_A_FRAME 1.0
#endif
