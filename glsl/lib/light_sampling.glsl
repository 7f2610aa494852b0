// Light that a surface point sends towards the eye by one sampled direction: of the sun, the sky, an emissive voxel.
// Multiple importance sampling (Veach 1997, power heuristic): what the scattered path may find too is weighted here
// and there.
#include "lib/rng.glsl"
#include "lib/sky.glsl"
#include "lib/vertex.glsl"
#ifdef TRACE_EMITTERS
#include "lib/emitters.glsl"
#include "lib/water_crossing.glsl"
#endif
#ifdef TRACE_SMOOTH_WATER
#include "lib/water_surface.glsl"
#endif

// Of each of x and z when the sun is sampled through the water's surface; the rest is the top.
const float SIDE_FACE_PROBABILITY = 0.0625;

// Interfaces that straight sunlight passes at most; a fall of water has some dozen.
const int STRAIGHT_LEGS_MAX = 24;

#ifdef TRACE_SUN
// Light of the sun that the vertex sends towards the eye, by one sampled direction. `start`: of rays to the sun; `across`:
// it lies beyond a rough interface. Under water the sun is connected through a smooth face of the water: faces are
// axis-aligned, so its refracted direction is one per orientation.
vec3 sampled_sun(Vertex v, RayStart start, bool across, bool through_water) {
    vec3 to_sun = sample_sun(rng_vec2());
    vec3 dir = to_sun;
    vec3 weight = sun_sample_weight();
    bool in_air = start.medium == MATERIAL_AIR;
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
    bool on_side = (wi.z > 0.0) != across && (component(dir, v.axis) * v.side > 0.0) != across;
    bool asked = (in_air || through_water) && on_side && max_component(light) > 0.0;
    RayStart ray = start;
    bool seen = false;
#ifdef TRACE_CLEAR
    // With caustics the same light is found by chance: not twice.
    bool straight = in_air && option(OPTION_STRAIGHT_SUNLIGHT) && !option(OPTION_CAUSTICS);
    float ior_here = 1.0;
    vec3 absorption = absorption_per_m(start.medium) * frame.trace_limits.y;
    for (int leg = 0; leg < STRAIGHT_LEGS_MAX; ++leg) {
        RayHit hit = trace_ray(ray, dir, asked ? frame.trace_limits.x : -1.0);
        bool ends = hit.kind == HIT_NONE;
        int hit_axis = hit.axis;
#ifdef TRACE_SMOOTH_WATER
        WaterFace water = water_face(ray.medium, dir, hit, hit_point(ray, dir, hit), false);
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
// How much of an emissive voxel counts when the path runs into it.
const int EMITTER_BY_CHANCE = 0;  // all: nothing else finds it
const int EMITTER_SAMPLED = 1;    // sampled at the last vertex: weighted against it
const int EMITTER_CROSSED = 2;    // the same through the water's surface, which the path has crossed since
const int EMITTER_MIRRORED = 3;   // the same by its mirror image in the surface, off which the path has come since

Receiver receiver_of(Vertex v) { return Receiver(v.start.origin_vox, v.axis, v.side); }

#ifdef TRACE_CLEAR
// As seen in the surface at `height`.
Receiver mirror_image(Receiver to, float height) {
    return Receiver(vec3(to.at_vox.x, 2.0 * height - to.at_vox.y, to.at_vox.z), to.axis, to.axis == 1 ? -to.side : to.side);
}

uint medium_at(ivec3 cell, vec3 point) {
    uint value = cell_byte(cell);
    bool dry = is_partly_filled(value) && point.y >= surface_height(cell, value);
    return dry ? MATERIAL_AIR : material_of(value);
}

// Whether a surface met at `height` is the one that light was connected through. Smooth water is shaded as level.
bool is_same_surface(float height, float connected) {
#ifdef TRACE_SMOOTH_WATER
    return abs(height - connected) <= WATER_STEP_MAX;
#else
    return height == connected;
#endif
}
#endif

// Light of one emissive voxel, by one sampled point on its faces: straight through the medium of the vertex; across the
// surface of smooth water where `across_water`; by its mirror image from below where `mirrored`. `above`: the height of
// the surface over a vertex under water.
vec3 sampled_emitter(Vertex v, bool across_water, float above, bool mirrored) {
    Receiver here = receiver_of(v);
#ifdef TRACE_CLEAR
    if (mirrored) here = mirror_image(here, above);
#endif
    EmitterSample emitter = sample_emitter(here);
    vec3 target = emitter.point_vox;
    bool asked = emitter.pdf > 0.0;
    vec3 dir = normalize(target - here.at_vox);
    float pdf = pdf_of_direction(emitter.pdf, here.at_vox, target, emitter.axis);
    float chance = 1.0;  // of the scattered path to go on as this one
    vec3 light = materials[material_of(cell_byte(emitter.cell))].emission_metallic.rgb;
#ifdef TRACE_CLEAR
    uint medium = medium_at(emitter.outside, target);
    bool crosses = across_water && !mirrored && is_air_to_water(v.start.medium, medium);
    // A loop that runs at most once: llvmpipe runs the body of a branch for lanes that do not take it.
    for (bool once = asked && crosses; once; once = false) {
        if (medium == MATERIAL_WATER) above = surface_above(RayStart(target, emitter.outside, medium));
        asked = above != NO_SURFACE && (here.at_vox.y - above) * (target.y - above) < 0.0;
        float eta = ior_of(medium) / ior_of(v.start.medium);
        Crossing crossing = cross_surface(here.at_vox, ior_of(v.start.medium), target, ior_of(medium), above);
        dir = normalize(crossing.at_vox - here.at_vox);
        vec3 onward = normalize(target - crossing.at_vox);
        pdf = emitter.pdf * crossing.area_per_angle / max(abs(onward[emitter.axis]), 1e-12);
        chance = crossing.transmittance;
        light *= crossing.transmittance / (eta * eta);
    }
    asked = asked && (crosses || medium == v.start.medium);
    if (mirrored) {
        dir.y = -dir.y;
        chance = fresnel_dielectric(abs(dir.y), ior_of(MATERIAL_AIR) / ior_of(v.start.medium));
        light *= chance;
    }
#endif
    vec3 f_cos;
    float pdf_scattered;
    vec3 wi = vertex_local(v, dir);
    vertex_eval(v, wi, f_cos, pdf_scattered);
    light *= f_cos;
#ifdef TRACE_SMOOTH_WATER
    // What chance finds this way is not counted.
    if (crosses || mirrored) pdf_scattered = 0.0;
#endif
    asked = asked && pdf > 0.0 && wi.z > 0.0 && max_component(light) > 0.0;
    light *= asked ? power_heuristic(pdf, pdf_scattered * chance) / pdf : 0.0;
    RayStart ray = v.start;
    bool seen = false;
#ifdef TRACE_CLEAR
    bool met = false;  // the surface
    for (int leg = 0; leg < STRAIGHT_LEGS_MAX && asked; ++leg) {
        RayHit hit = trace_ray(ray, dir, frame.trace_limits.x);
        light *= exp(-absorption_per_m(ray.medium) * (frame.trace_limits.y * hit.t));
        seen = met == (crosses || mirrored) && hit.kind == HIT_FACE && hit.cell == emitter.cell && hit.axis == emitter.axis;
        vec3 point = hit_point(ray, dir, hit);
        int hit_axis = hit.axis;
#ifdef TRACE_SMOOTH_WATER
        WaterFace water = water_face(ray.medium, dir, hit, point, false);
        if (water.is_smooth && !water.met) {
            ray = water.start;
            continue;
        }
        if (water.is_smooth) hit_axis = 1;
#endif
        bool onward = (crosses || mirrored) && !met && hit.kind != HIT_NONE && hit_axis == 1 &&
                      hit.beyond == (mirrored ? MATERIAL_AIR : medium) && is_same_surface(point.y, above);
        if (!onward) break;
        met = true;
        ray = RayStart(point, mirrored ? hit.previous : hit.cell, medium);
        dir = normalize(target - point);
    }
#else
    RayHit hit = trace_ray(ray, dir, asked ? frame.trace_limits.x : -1.0);
    seen = hit.kind == HIT_FACE && hit.cell == emitter.cell && hit.axis == emitter.axis;
#endif
    return asked && seen ? light : vec3(0.0);
}

// The part of an emissive voxel's light that a scattered path adds which meets it at `hit`, `at` on its face. `pdf` is the
// density of that path; unless EMITTER_SAMPLED it met the water's surface at `met_at`, `above` as in sampled_emitter.
float emitter_weight(int state, Receiver from, RayHit hit, RayStart at, float pdf, float met_at, float above) {
    vec3 point = at.origin_vox;
#ifdef TRACE_CLEAR
    bool under = at.medium == MATERIAL_WATER;
    if (state != EMITTER_SAMPLED) {
        for (bool once = state == EMITTER_CROSSED && under; once; once = false) above = surface_above(at);
        if (above == NO_SURFACE || !is_same_surface(met_at, above)) return 1.0;
#ifdef TRACE_SMOOTH_WATER
        return 0.0;
#endif
    }
    if (state == EMITTER_MIRRORED) from = mirror_image(from, above);
#endif
    float pdf_sampled = emitter_pdf(from, hit.cell, hit.axis);
#ifdef TRACE_CLEAR
    if (state == EMITTER_CROSSED) {
        float ior_here = ior_of(under ? MATERIAL_AIR : MATERIAL_WATER);
        Crossing crossing = cross_surface(from.at_vox, ior_here, point, ior_of(at.medium), above);
        vec3 onward = normalize(point - crossing.at_vox);
        return power_heuristic(pdf, pdf_sampled * crossing.area_per_angle / max(abs(onward[hit.axis]), 1e-12));
    }
#endif
    return power_heuristic(pdf, pdf_of_direction(pdf_sampled, from.at_vox, point, hit.axis));
}
#endif
