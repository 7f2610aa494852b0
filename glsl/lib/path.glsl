// The path tracer: one path from the eye, its light, and the first surface it meets. Options, so that what a scene
// does not contain costs nothing: TRACE_CLEAR (water or glass), TRACE_ROUGH (some of it rough), TRACE_COATED (opaque
// materials with an interface), TRACE_METAL (metals among them; needs TRACE_COATED), TRACE_SUN and TRACE_SKY (light
// sampling), TRACE_SMOOTH_WATER (water's levels shaded as one surface; needs TRACE_CLEAR).
#include "shared/frame.h"
#include "shared/trace.h"
#include "lib/bsdf.glsl"
#include "lib/rng.glsl"
#include "lib/sky.glsl"
#include "lib/traversal.glsl"
#ifdef TRACE_SMOOTH_WATER
#include "lib/water_surface.glsl"
#endif

bool option(int bit) { return (frame.trace_options.w & bit) != 0; }

// How much of the sun's disc counts when the path runs into it: what light sampling has found already must not
// count twice.
const int SUN_SEEN = 0;         // only mirrors and smooth interfaces since the eye, or no light sampling
const int SUN_SAMPLED = 1;      // sampled at the last vertex: weighted against it
const int SUN_UNDER_WATER = 2;  // sampled through the surface; the path is still in the water
const int SUN_CONNECTED = 3;    // left the water by one refraction: all of it was sampled
const int SUN_BY_CHANCE = 4;    // nothing but chance finds it: a caustic

// Of each of x and z when the sun is sampled through the water's surface; the rest is the top.
const float SIDE_FACE_PROBABILITY = 0.0625;

// Interfaces that straight sunlight passes at most; a fall of water has some dozen.
const int STRAIGHT_LEGS_MAX = 24;

// Low steps of smooth water that a path passes at most; then they scatter as the faces they are.
const int WATER_STEPS_PASSED_MAX = 64;

struct FirstSurface {
    vec3 position_vox;  // of the first hit; far along the ray where there is none
    vec3 normal;        // 0 for sky
    float distance_vox;
    uint material;      // id; SURFACE_SKY for sky
};

// World axes to the local frame whose z is the axis of the normal, and back; side: the normal's sign.
vec3 to_local(vec3 v, int axis, float side) {
    vec3 p = axis == 0 ? v.yzx : axis == 1 ? v.zxy : v;
    return vec3(p.xy, p.z * side);
}
vec3 from_local(vec3 v, int axis, float side) {
    vec3 p = vec3(v.xy, v.z * side);
    return axis == 0 ? p.zxy : axis == 1 ? p.yzx : p;
}

vec3 axis_vector(int axis, float side) { return vec3(axis == 0 ? side : 0.0, axis == 1 ? side : 0.0, axis == 2 ? side : 0.0); }

float component(vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

float power_heuristic(float a, float b) {
    // In this form neither square overflows.
    if (a <= 0.0) return 0.0;
    float r = b / a;
    return 1.0 / (1.0 + r * r);
}

vec3 limited(vec3 light, int bounce) {
    float limit = frame.trace_limits.z;
    float m = max_component(light);
    return limit > 0.0 && bounce > 0 && m > limit ? light * (limit / m) : light;
}

// A surface point that scatters.
struct Vertex {
    RayStart start;  // of rays that leave it on this side
    int axis;        // of its normal
    float side;
    vec3 wo;         // local
    Surface surface;
#ifdef TRACE_SMOOTH_WATER
    mat3 tilt;       // from the frame of the shading normal to that of the axis
#endif
};

// Directions to the frame in which the vertex scatters, and back.
vec3 vertex_local(Vertex v, vec3 dir) {
#ifdef TRACE_SMOOTH_WATER
    return to_local(dir, v.axis, v.side) * v.tilt;
#else
    return to_local(dir, v.axis, v.side);
#endif
}
vec3 vertex_world(Vertex v, vec3 local) {
#ifdef TRACE_SMOOTH_WATER
    return from_local(v.tilt * local, v.axis, v.side);
#else
    return from_local(local, v.axis, v.side);
#endif
}

void vertex_eval(Vertex v, vec3 wi, out vec3 f_cos, out float pdf) {
#ifdef TRACE_ROUGH
    if (v.surface.transmissive)
        dielectric_eval(v.surface, v.wo, wi, f_cos, pdf);
    else
#endif
        opaque_eval(v.surface, v.wo, wi, option(OPTION_UNIFORM_DIFFUSE), f_cos, pdf);
}

#ifdef TRACE_SUN
// Light of the sun that the vertex sends towards the eye, by one sampled direction. Under water the sun is connected
// through a smooth face of the water: faces are axis-aligned, so its refracted direction is one per orientation.
vec3 sampled_sun(Vertex v, bool through_water) {
    vec3 to_sun = sample_sun(rng_vec2());
    vec3 dir = to_sun;
    vec3 weight = sun_sample_weight();
    bool in_air = v.start.medium == MATERIAL_AIR;
#ifdef TRACE_CLEAR
    int face = 1;
    if (through_water) {
        float choice = rng_float();
        face = choice < SIDE_FACE_PROBABILITY ? 0 : choice < 2.0 * SIDE_FACE_PROBABILITY ? 2 : 1;
        vec3 n = axis_vector(face, component(to_sun, face) < 0.0 ? -1.0 : 1.0);
        float cos_i = dot(to_sun, n);
        float eta = ior_of(MATERIAL_WATER);
        vec3 into;
        bool enters = refract_through(to_sun, n, eta, into) && cos_i > 0.0;
        dir = -into;
        // Irradiance E becomes E (1 - F) cos_i / cos_t across the beam in the water.
        float probability = face == 1 ? 1.0 - 2.0 * SIDE_FACE_PROBABILITY : SIDE_FACE_PROBABILITY;
        float scale = (1.0 - fresnel_dielectric(cos_i, eta)) * cos_i / (dot(dir, n) * probability);
        weight = enters ? weight * scale : vec3(0.0);
    }
#endif
    vec3 f_cos;
    float pdf;
    vec3 wi = vertex_local(v, dir);
    vertex_eval(v, wi, f_cos, pdf);
    if (in_air && frame.sun_irradiance.w > 0.0) weight *= power_heuristic(1.0 / frame.sun_irradiance.w, pdf);
    vec3 light = f_cos * weight;
    // The ray leaves on this side: what a rough interface passes to the other is left to chance.
    bool asked = (in_air || through_water) && wi.z > 0.0 && max_component(light) > 0.0;
    RayStart ray = v.start;
    bool seen = false;
#ifdef TRACE_CLEAR
    // With caustics the same light is found by chance: not twice.
    bool straight = in_air && option(OPTION_STRAIGHT_SUNLIGHT) && !option(OPTION_CAUSTICS);
    float ior_here = 1.0;
    vec3 absorption = absorption_per_m(v.start.medium) * frame.trace_limits.y;
    for (int leg = 0; leg < STRAIGHT_LEGS_MAX; ++leg) {
        RayHit hit = trace_ray(ray, dir, asked ? frame.trace_limits.x : -1.0);
        bool ends = hit.kind == HIT_NONE;
        int hit_axis = hit.axis;
#ifdef TRACE_SMOOTH_WATER
        WaterFace water = water_face(ray.medium, dir, hit, hit_point(ray, dir, hit));
        if (water.is_smooth && !water.met && ray.medium == MATERIAL_AIR) {
            ray = water.start;
            continue;
        }
        if (water.is_smooth) hit_axis = 1;
#endif
        // From under water the one way on is out of the face that was aimed at.
        bool leaves = through_water && leg == 0 && hit.beyond == MATERIAL_AIR && hit_axis == face &&
                      component(dir, face) * component(to_sun, face) > 0.0;
        if (ends || !(leaves || (straight && transmits(hit.beyond)))) {
            seen = ends && (in_air || leg > 0);
            break;
        }
        light *= exp(-absorption * hit.t);
        RayStart beyond = RayStart(hit_point(ray, dir, hit), hit.cell, hit.beyond);
        if (straight) {
            float ior_beyond = ior_of(hit.beyond);
            light *= 1.0 - fresnel_dielectric(abs(component(dir, hit_axis)), ior_beyond / ior_here);
            ior_here = ior_beyond;
        } else {
            dir = to_sun;
        }
        absorption = absorption_per_m(hit.beyond) * frame.trace_limits.y;
        ray = beyond;
    }
#else
    seen = trace_ray(ray, dir, asked ? frame.trace_limits.x : -1.0).kind == HIT_NONE;
#endif
    return asked && seen ? light : vec3(0.0);
}
#endif

#ifdef TRACE_SKY
// Light of the sky that an opaque vertex in air sends towards the eye, by one cosine-weighted direction.
vec3 sampled_sky(Vertex v) {
    vec2 u = rng_vec2();
    float phi = 2.0 * PI * u.x;
    vec3 wi = vec3(sqrt(u.y) * cos(phi), sqrt(u.y) * sin(phi), sqrt(1.0 - u.y));
    vec3 f_cos;
    float pdf;
    opaque_eval(v.surface, v.wo, wi, option(OPTION_UNIFORM_DIFFUSE), f_cos, pdf);
    float sky_pdf = wi.z * INV_PI;
    vec3 dir = vertex_world(v, wi);
    vec3 light = sky_pdf > 0.0 ? f_cos * sky_radiance(dir) * (power_heuristic(sky_pdf, pdf) / sky_pdf) : vec3(0.0);
    bool asked = v.start.medium == MATERIAL_AIR && !v.surface.transmissive && max_component(light) > 0.0;
    RayHit hit = trace_ray(v.start, dir, asked ? frame.trace_limits.x : -1.0);
    return asked && hit.kind == HIT_NONE ? light : vec3(0.0);
}
#endif

// Radiance along the ray of the eye from `eye_vox` towards `dir` (unit).
vec3 trace_path(vec3 eye_vox, vec3 dir, out FirstSurface first) {
    first = FirstSurface(eye_vox + dir * 1e6, vec3(0.0), 1e6, SURFACE_SKY);
    float t_entry;
    RayStart ray;
    vec3 light = vec3(0.0);
    vec3 throughput = vec3(1.0);
    int sun_state = SUN_SEEN;
    float pdf_last = 0.0;      // of the last scattering
    float sky_pdf_last = 0.0;  // with which sky sampling would have made the same direction; 0: it could not
    if (!enter_world(eye_vox, dir, ray, t_entry))
        return sky_radiance(dir) + (in_sun_disc(dir) ? frame.sun_radiance.rgb : vec3(0.0));
    if (!transmits(ray.medium)) return vec3(0.0);  // the eye is inside a solid
    float t_max = frame.trace_limits.x;
    float eye_ior = ior_of(ray.medium);
    float medium_ior = eye_ior;
#ifdef TRACE_CLEAR
    vec3 absorption = absorption_per_m(ray.medium) * frame.trace_limits.y;
    float water_roughness = materials[MATERIAL_WATER].base_roughness.w;
    bool through_smooth_water = option(OPTION_SUN_THROUGH_WATER) && water_roughness * water_roughness < ALPHA_SMOOTH;
#endif

#ifdef TRACE_SMOOTH_WATER
    int steps_passed = 0;
#endif
    int diffuse_bounces = 0;
    for (int bounce = 0;; ++bounce) {
        RayHit hit = trace_ray(ray, dir, t_max);
#ifdef TRACE_CLEAR
        throughput *= exp(-absorption * hit.t);
#endif
        if (hit.kind == HIT_NONE) {
            float sky_weight = sky_pdf_last > 0.0 ? power_heuristic(pdf_last, sky_pdf_last) : 1.0;
            float sun_weight = sun_state == SUN_SEEN ? 1.0 : 0.0;
            if (sun_state == SUN_SAMPLED) sun_weight = power_heuristic(pdf_last, 1.0 / frame.sun_irradiance.w);
            if (sun_state == SUN_BY_CHANCE && option(OPTION_CAUSTICS)) sun_weight = 1.0;
            vec3 arriving = sky_radiance(dir) * sky_weight;
            if (in_sun_disc(dir)) arriving += frame.sun_radiance.rgb * sun_weight;
            light += limited(throughput * arriving, bounce);
            break;
        }
        Vertex v;
        v.axis = hit.axis;
        v.side = component(dir, hit.axis) > 0.0 ? -1.0 : 1.0;
        v.start = RayStart(hit_point(ray, dir, hit), hit.previous, ray.medium);
#ifdef TRACE_SMOOTH_WATER
        vec3 point = v.start.origin_vox;
        WaterFace water = water_face(ray.medium, dir, hit, point);
        if (water.is_smooth && !water.met && steps_passed < WATER_STEPS_PASSED_MAX) {
            ++steps_passed;
            --bounce;
            t_entry += hit.t;
            ray = water.start;
            continue;
        }
        water.is_smooth = water.is_smooth && water.met;
        v.tilt = mat3(1.0);
        if (water.is_smooth) {
            v.axis = 1;
            v.side = dir.y < 0.0 ? 1.0 : -1.0;
            v.start = water.start;
            vec2 gradient = water_gradient(point, water.surface, water.level);
            v.tilt = basis_around(to_local(water_normal(gradient, v.side, -dir), 1, v.side));
        }
#endif
        if (bounce == 0) {
            uint shown = hit.beyond == MATERIAL_AIR ? ray.medium : hit.beyond;
            first = FirstSurface(v.start.origin_vox, axis_vector(v.axis, v.side), t_entry + hit.t, shown);
        }
        Material beyond = materials[hit.beyond];
        light += limited(throughput * beyond.emission_metallic.rgb, bounce);
        if (bounce >= frame.trace_options.x) break;
        v.wo = vertex_local(v, -dir);
        v.surface = surface_of(beyond, hit.beyond, ray.medium, medium_ior);
        bool delta = v.surface.transmissive && is_smooth(v.surface);
        if (!delta && diffuse_bounces >= frame.trace_options.z) break;

        bool light_sampled = false;  // the sun was, from here
        bool under_water = false;
#ifdef TRACE_CLEAR
        under_water = ray.medium == MATERIAL_WATER && through_smooth_water && !v.surface.transmissive;
#endif
#ifdef TRACE_SUN
        light_sampled = !delta && (ray.medium == MATERIAL_AIR || under_water);
        if (light_sampled) light += limited(throughput * sampled_sun(v, under_water), bounce + 1);
#endif
#ifdef TRACE_SKY
        light += limited(throughput * sampled_sky(v), bounce + 1);
#endif

        vec3 u = vec3(rng_vec2(), 0.0);
        u.z = rng_float();
        BsdfSample next = opaque_sample(v.surface, v.wo, u, option(OPTION_UNIFORM_DIFFUSE));
#ifdef TRACE_CLEAR
        if (v.surface.transmissive) next = dielectric_sample(v.surface, v.wo, u);
#endif
        throughput *= next.weight;
        diffuse_bounces += next.diffuse ? 1 : 0;
        bool transmitted = next.wi.z < 0.0;
        bool to_air = transmitted && hit.beyond == MATERIAL_AIR;
        ray = v.start;
        if (transmitted) {
            ray.cell = hit.cell;
            ray.medium = hit.beyond;
            medium_ior = beyond.absorption_ior.w;
#ifdef TRACE_CLEAR
            absorption = beyond.absorption_ior.xyz * frame.trace_limits.y;
#endif
        }
        dir = normalize(vertex_world(v, next.wi));
#ifdef TRACE_SMOOTH_WATER
        if (transmitted) ray.origin_vox = point;
        if (water.is_smooth && transmitted != (dir.y * v.side < 0.0)) {
            // Through the surface as it is: a smooth one lays the ray on the right side, a rough one ends it.
            dir.y = -dir.y;
            if (next.pdf > 0.0) throughput = vec3(0.0);
        }
#endif
#ifdef TRACE_SUN
        if (next.pdf > 0.0) {
            bool sampled = light_sampled && !transmitted;
            sun_state = !sampled ? SUN_BY_CHANCE : under_water ? SUN_UNDER_WATER : SUN_SAMPLED;
            pdf_last = next.pdf;
        } else if (sun_state != SUN_SEEN) {
            sun_state = sun_state == SUN_UNDER_WATER && to_air ? SUN_CONNECTED : SUN_BY_CHANCE;
        }
#endif
#ifdef TRACE_SKY
        bool sky_sampled = next.pdf > 0.0 && v.start.medium == MATERIAL_AIR && !v.surface.transmissive;
        sky_pdf_last = sky_sampled ? next.wi.z * INV_PI : 0.0;
        pdf_last = next.pdf;
#endif
        float survival = 1.0;
        if (bounce >= frame.trace_options.y) {
            // Radiance is scaled by the index squared while inside a medium; survival must not depend on it.
            float scale = medium_ior / eye_ior;
            survival = min(0.95, max_component(throughput) * scale * scale);
        }
        if (max_component(throughput) <= 0.0 || (survival < 1.0 && rng_float() >= survival)) break;
        throughput /= survival;
    }
    return light;
}
