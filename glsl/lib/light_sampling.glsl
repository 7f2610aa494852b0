// Light that a surface point sends towards the eye by one sampled direction: of the sun, the sky, an emissive voxel.
// Multiple importance sampling (Veach 1997, power heuristic): what the scattered path may find too is weighted here
// and there.
#include "lib/rng.glsl"
#include "lib/sky.glsl"
#include "lib/vertex.glsl"
#ifdef TRACE_EMITTERS
#include "lib/emitters.glsl"
#endif
#ifdef TRACE_SMOOTH_WATER
#include "lib/water_surface.glsl"
#endif

// Of each of x and z when the sun is sampled through the water's surface; the rest is the top.
const float SIDE_FACE_PROBABILITY = 0.0625;

// Interfaces that straight sunlight passes at most; a fall of water has some dozen.
const int STRAIGHT_LEGS_MAX = 24;

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
    vertex_eval(v, vertex_local(v, dir), f_cos, pdf);
    if (in_air && frame.sun_irradiance.w > 0.0) weight *= power_heuristic(1.0 / frame.sun_irradiance.w, pdf);
    vec3 light = f_cos * weight;
    bool asked = (in_air || through_water) && max_component(light) > 0.0;
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

#ifdef TRACE_EMITTERS
Receiver receiver_of(Vertex v) { return Receiver(v.start.origin_vox, v.axis, v.side); }

// Light of one emissive voxel in the medium of the vertex, by one sampled point on its faces.
vec3 sampled_emitter(Vertex v) {
    Receiver here = receiver_of(v);
    EmitterSample emitter = sample_emitter(here);
    vec3 dir = normalize(emitter.point_vox - here.at_vox);
    vec3 f_cos;
    float pdf;
    vertex_eval(v, vertex_local(v, dir), f_cos, pdf);
    vec3 light = f_cos * materials[material_of(cell_byte(emitter.cell))].emission_metallic.rgb;
    bool asked = emitter.pdf > 0.0 && max_component(light) > 0.0;
    light *= asked ? power_heuristic(emitter.pdf, pdf) / emitter.pdf : 0.0;
    RayStart ray = v.start;
    float distance_vox = 0.0;
    bool seen = false;
#ifdef TRACE_SMOOTH_WATER
    for (int leg = 0; leg < STRAIGHT_LEGS_MAX && asked; ++leg)
#endif
    {
        RayHit hit = trace_ray(ray, dir, asked ? frame.trace_limits.x : -1.0);
        distance_vox += hit.t;
        seen = hit.kind == HIT_FACE && hit.cell == emitter.cell && hit.axis == emitter.axis;
#ifdef TRACE_SMOOTH_WATER
        WaterFace water = water_face(ray.medium, dir, hit, hit_point(ray, dir, hit));
        if (!water.is_smooth || water.met) break;
        ray = water.start;
#endif
    }
#ifdef TRACE_CLEAR
    light *= exp(-absorption_per_m(v.start.medium) * (frame.trace_limits.y * distance_vox));
#endif
    return asked && seen ? light : vec3(0.0);
}
#endif
