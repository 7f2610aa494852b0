// The path tracer: one path from the eye, its light, and the first surface it meets. Options, so that what a scene
// does not contain costs nothing: TRACE_CLEAR (water or glass), TRACE_ROUGH (some of it rough), TRACE_COATED (opaque
// materials with an interface, metals), TRACE_SUN, TRACE_SKY and
// TRACE_EMITTERS (light sampling), TRACE_SMOOTH_WATER (water's levels shaded as one surface; needs TRACE_CLEAR),
// TRACE_COUNT (bounces and steps, for views). What a program can do beyond what its scene has changes no bit of the
// picture: nothing there draws random numbers.
#include "lib/light_sampling.glsl"

#ifdef TRACE_COUNT
int path_bounces = 0;  // of the last path: scatterings after which it went on
#endif

// How much of the sun's disc counts when the path runs into it: what light sampling has found already must not
// count twice.
const int SUN_SEEN = 0;         // only mirrors and smooth interfaces since the eye, or no light sampling
const int SUN_SAMPLED = 1;      // sampled at the last vertex: weighted against it
const int SUN_UNDER_WATER = 2;  // sampled through the surface; the path is still in the water
const int SUN_CONNECTED = 3;    // left the water by one refraction: all of it was sampled
const int SUN_BY_CHANCE = 4;    // nothing but chance finds it: a caustic

// Of a path's throughput, the part with which it survives Russian roulette. With 1 `balanced` (lake, 160x90, 8 frames)
// has half again the error at the same time.
const float ROULETTE_SURVIVAL = 2.0;

// Paths of at most so many bounces end without help. In falling water, where light loses little at each of some dozen
// interfaces, chance would end half of them, and what comes through flicker.
const int BOUNCES_UNAIDED = 64;

// Low steps of smooth water that a path passes at most; then they scatter as the faces they are.
const int WATER_STEPS_PASSED_MAX = 64;

struct FirstSurface {
    vec3 position_vox;  // of the first hit; 0 for sky
    vec3 normal;        // 0 for sky and inside a solid
    uint material;      // id; SURFACE_SKY for sky
    // What a smooth surface mirrors (negative) or lets through, also through the far side of a pane: how far behind it
    // that seems to lie along the ray of the eye; 0: nothing or not known
    float image_vox;
};

// Radiance along the ray of the eye from `eye_vox` towards `dir` (unit).
vec3 trace_path(vec3 eye_vox, vec3 dir, out FirstSurface first) {
    first = FirstSurface(vec3(0.0), vec3(0.0), SURFACE_SKY, 0.0);
    float t_entry;
    RayStart ray;
    vec3 light = vec3(0.0);
    vec3 throughput = vec3(1.0);
    int sun_state = SUN_SEEN;
    float pdf_last = 0.0;      // of the last scattering
    float sky_pdf_last = 0.0;  // with which sky sampling would have made the same direction; 0: it could not
#ifdef TRACE_EMITTERS
    bool has_emitters = any_emitter();
    int emitter_state = EMITTER_BY_CHANCE;
    Receiver receiver = Receiver(vec3(0.0), 0, 1.0);  // the last vertex that scattered
    float above = NO_SURFACE;                         // it, where it lies under water
    float met_at = 0.0;
#endif
    if (!enter_world(eye_vox, dir, ray, t_entry))
        return sky_radiance(dir) + (in_sun_disc(dir) ? frame.sun_radiance.rgb : vec3(0.0));
    if (!transmits(ray.medium)) {  // the eye is inside a solid
        first = FirstSurface(eye_vox, vec3(0.0), ray.medium, 0.0);
        return vec3(0.0);
    }
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
    float image_vox = 0.0;
    float image_scale = 0.0;  // its growth with the way; 0: scattered elsewhere
    int image_axis = 0;
    for (int bounce = 0;; ++bounce) {
        RayHit hit = trace_ray(ray, dir, t_max);
        image_vox += image_scale * hit.t;
#ifdef TRACE_COUNT
        path_bounces = bounce;
#endif
#ifdef TRACE_CLEAR
        throughput *= exp(-absorption * hit.t);
#endif
        if (hit.kind == HIT_NONE) {
            if (image_scale != 0.0) first.image_vox = sign(image_scale) * IMAGE_FAR_VOX;
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
        WaterFace water = water_face(ray.medium, dir, hit, point, true);
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
            v.tilt = basis_around(to_local(water_normal(water.gradient, v.side, -dir), 1, v.side));
        }
#endif
        if (bounce == 0) {
            uint shown = hit.beyond == MATERIAL_AIR ? ray.medium : hit.beyond;
            first = FirstSurface(v.start.origin_vox, axis_vector(v.axis, v.side), shown, 0.0);
        }
        Material beyond = materials[hit.beyond];
        vec3 emitted = beyond.emission_metallic.rgb;
#ifdef TRACE_EMITTERS
        // A loop that runs at most once: llvmpipe runs the body of a branch for lanes that do not take it.
        bool sampled_too = emitter_state != EMITTER_BY_CHANCE && hit.kind == HIT_FACE && is_emitter(hit.byte_beyond);
        for (bool once = sampled_too; once; once = false)
            emitted *= emitter_weight(emitter_state, receiver, hit, v.start, pdf_last, met_at, above);
#endif
        light += limited(throughput * emitted, bounce);
        v.wo = vertex_local(v, -dir);
        v.surface = surface_of(beyond, hit.beyond, ray.medium, medium_ior);
        bool delta = v.surface.transmissive && is_smooth(v.surface);
        if (image_scale != 0.0 && !delta) first.image_vox = image_vox;
        if (bounce >= frame.trace_options.x) break;
        if (!delta && diffuse_bounces >= frame.trace_options.z) break;

#ifdef TRACE_SUN
        // Rays to the sun start on this side, but out of glass and of rough water beyond the interface.
        RayStart sunward = v.start;
        bool across = false;
        bool under_water = false;
#ifdef TRACE_ROUGH
        across = !delta && v.surface.transmissive && ray.medium != MATERIAL_AIR &&
                 (hit.beyond == MATERIAL_AIR || ray.medium == MATERIAL_GLASS);
        if (across) sunward = RayStart(v.start.origin_vox, hit.cell, hit.beyond);
#ifdef TRACE_SMOOTH_WATER
        if (across) sunward.origin_vox = point;
#endif
#endif
#ifdef TRACE_CLEAR
        under_water = sunward.medium == MATERIAL_WATER && through_smooth_water;
#endif
        bool sun_sampled =
            frame.sun_radiance.w > 0.0 && !delta && (sunward.medium == MATERIAL_AIR || under_water);
        if (sun_sampled) light += limited(throughput * sampled_sun(v, sunward, across, under_water), bounce + 1);
#endif
#ifdef TRACE_SKY
        light += limited(throughput * sampled_sky(v), bounce + 1);
#endif
#ifdef TRACE_EMITTERS
        bool across_water = false;
#ifdef TRACE_CLEAR
        across_water = through_smooth_water;
        for (bool once = has_emitters && !delta && across_water; once; once = false)
            above = ray.medium == MATERIAL_WATER ? surface_above(v.start) : NO_SURFACE;
#endif
        int images = delta || !has_emitters ? 0 : across_water && above != NO_SURFACE ? 2 : 1;
        for (int image = 0; image < images; ++image)
            light += limited(throughput * sampled_emitter(v, across_water, above, image == 1), bounce + 1);
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
        if (bounce == 0) image_axis = v.axis;
        // Seen through parallel planes a point lies by its way over the index along the ray (sines to the normal).
        bool straight = bounce == 0 || (image_scale > 0.0 && transmitted && v.axis == image_axis);
        image_scale = next.pdf > 0.0 || !straight ? 0.0 : transmitted ? eye_ior / medium_ior : -1.0;
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
            bool sampled = sun_sampled && transmitted == across;
            sun_state = !sampled ? SUN_BY_CHANCE : under_water ? SUN_UNDER_WATER : SUN_SAMPLED;
        } else if (sun_state != SUN_SEEN) {
            sun_state = sun_state == SUN_UNDER_WATER && to_air ? SUN_CONNECTED : SUN_BY_CHANCE;
        }
#endif
#ifdef TRACE_SKY
        bool sky_sampled = next.pdf > 0.0 && v.start.medium == MATERIAL_AIR && !v.surface.transmissive;
        sky_pdf_last = sky_sampled ? next.wi.z * INV_PI : 0.0;
#endif
        if (next.pdf > 0.0) pdf_last = next.pdf;
#ifdef TRACE_EMITTERS
        if (next.pdf > 0.0) {
            receiver = receiver_of(v);
            emitter_state = delta || transmitted ? EMITTER_BY_CHANCE : EMITTER_SAMPLED;
        } else {
            int state = EMITTER_BY_CHANCE;
#ifdef TRACE_CLEAR
            bool onward = emitter_state == EMITTER_SAMPLED && across_water && v.axis == 1 &&
                          is_air_to_water(v.start.medium, hit.beyond);
            if (onward && transmitted) state = EMITTER_CROSSED;
            if (onward && !transmitted && v.start.medium == MATERIAL_WATER) state = EMITTER_MIRRORED;
            float reflectance = fresnel_dielectric(v.wo.z, v.surface.eta);
            pdf_last *= state == EMITTER_CROSSED ? 1.0 - reflectance : state == EMITTER_MIRRORED ? reflectance : 1.0;
#endif
            emitter_state = state;
            met_at = v.start.origin_vox.y;
        }
#endif
        float survival = 1.0;
        if (bounce >= frame.trace_options.y) {
            // Radiance is scaled by the index squared while inside a medium; survival must not depend on it.
            float scale = medium_ior / eye_ior;
            float most = frame.trace_options.x <= BOUNCES_UNAIDED ? 1.0 : 0.95;
            survival = min(most, ROULETTE_SURVIVAL * max_component(throughput) * scale * scale);
        }
        if (max_component(throughput) <= 0.0 || (survival < 1.0 && rng_shared(bounce) >= survival)) break;
        throughput /= survival;
    }
    return light;
}
