// The path tracer: one path from the eye, its light, and the first surface it meets.
#include "shared/frame.h"
#include "lib/bsdf.glsl"
#include "lib/rng.glsl"
#include "lib/sky.glsl"
#include "lib/traversal.glsl"

// Bits of frame.trace_options.w, as renderer.cpp sets them.
const int OPTION_SUN_THROUGH_WATER = 1;
const int OPTION_CAUSTICS = 2;
const int OPTION_UNIFORM_DIFFUSE = 4;
const int OPTION_JITTER = 8;
// frame.trace_options.z
const int LIGHT_SUN = 1;
const int LIGHT_SUN_AND_SKY = 2;

bool option(int bit) { return (frame.trace_options.w & bit) != 0; }

// How much of the sun's disc counts when the path runs into it: what light sampling has found already must not
// count twice.
const int SUN_SEEN = 0;       // only mirrors and smooth interfaces since the eye
const int SUN_SAMPLED = 1;    // sampled at the last vertex: weighted against it
const int SUN_UNDER_WATER = 2;  // sampled through the surface; the path is still in the water
const int SUN_CONNECTED = 3;  // left the water by one refraction: all of it was sampled
const int SUN_BY_CHANCE = 4;  // nothing but chance finds it: a caustic

const float SIDE_FACE_PROBABILITY = 0.125;  // of each of x and z; the top face is always connected

struct FirstSurface {
    vec3 position_vox;  // of the first hit; far along the ray where there is none
    vec3 normal;        // 0 for sky
    float distance_vox;
    uint material;      // id; SURFACE_SKY for sky
};
const uint SURFACE_SKY = 255u;

// A surface point from which the path goes on: the light it receives is sampled ray by ray.
struct Vertex {
    vec3 position_vox;
    ivec3 cell;    // on this side
    ivec3 cell_beyond;
    uint medium;
    uint beyond;
    vec3 wo;       // local
    mat3 world_from_local;
    Surface surface;
    bool delta;
};

vec3 axis_normal(int axis, vec3 dir) {
    vec3 n = vec3(0.0);
    n[axis] = dir[axis] > 0.0 ? -1.0 : 1.0;
    return n;
}

vec3 transmittance(uint medium, float t_vox) {
    if (medium == MATERIAL_AIR) return vec3(1.0);
    return exp(-absorption_per_m(medium) * (t_vox * frame.trace_limits.y));
}

float power_heuristic(float a, float b) {
    // In this form neither square overflows.
    if (a <= 0.0) return 0.0;
    float r = b / a;
    return 1.0 / (1.0 + r * r);
}

vec3 limited(vec3 light, int bounce) {
    float limit = frame.trace_limits.z;
    if (limit <= 0.0 || bounce == 0) return light;
    float m = max_component(light);
    return m > limit ? light * (limit / m) : light;
}

void vertex_eval(Vertex v, vec3 wi_local, out vec3 f_cos, out float pdf) {
    if (v.surface.transmissive)
        dielectric_eval_reflection(v.surface, v.wo, wi_local, f_cos, pdf);
    else
        opaque_eval(v.surface, v.wo, wi_local, option(OPTION_UNIFORM_DIFFUSE), f_cos, pdf);
}

// Stages of a vertex: shadow rays first, then the path goes on.
const int STAGE_PATH = 0;
const int STAGE_SUN = 1;
const int STAGE_SUN_SIDE = 2;  // under water, through a side face
const int STAGE_SKY = 3;
const int STAGE_NEXT = 4;

// Radiance along the ray of the eye from `eye_vox` towards `dir` (unit).
vec3 trace_path(vec3 eye_vox, vec3 dir, out FirstSurface first) {
    first.position_vox = eye_vox + dir * 1e6;
    first.normal = vec3(0.0);
    first.distance_vox = 1e6;
    first.material = SURFACE_SKY;

    float t_entry;
    RayStart ray;
    vec3 light = vec3(0.0);
    vec3 throughput = vec3(1.0);
    int sun_state = SUN_SEEN;
    float pdf_last = 0.0;     // of the last scattering; 0 after a delta
    float sky_pdf_last = 0.0; // with which sky sampling would have made the same direction
    if (!enter_world(eye_vox, dir, ray, t_entry)) {
        light = sky_radiance(dir);
        return in_sun_disc(dir) ? light + frame.sun_radiance.rgb : light;
    }
    float eye_ior = ior_of(ray.medium);
    if (!transmits(ray.medium)) return vec3(0.0);  // the eye is inside a solid

    float water_roughness = materials[MATERIAL_WATER].base_roughness.w;
    bool under_water_sampling = option(OPTION_SUN_THROUGH_WATER) && water_roughness * water_roughness < ALPHA_SMOOTH;
    Vertex v;
    vec3 pending = vec3(0.0);   // light that arrives if the shadow ray does
    vec3 sun_leg_dir = vec3(0.0);  // beyond the water's surface
    bool under_water_leg = false;
    int sun_axis = 1;
    int stage = STAGE_PATH;
    int bounce = 0;
    float t_max = frame.trace_limits.x;

    while (true) {
        RayHit hit = trace_ray(ray, dir, t_max);
        if (stage == STAGE_PATH) {
            throughput *= transmittance(ray.medium, hit.t);
            if (hit.kind == HIT_NONE) {
                float sky_weight = sky_pdf_last > 0.0 ? power_heuristic(pdf_last, sky_pdf_last) : 1.0;
                vec3 arriving = sky_radiance(dir) * sky_weight;
                if (in_sun_disc(dir)) {
                    float w = 1.0;
                    if (sun_state == SUN_SAMPLED) w = power_heuristic(pdf_last, 1.0 / frame.sun_irradiance.w);
                    if (sun_state == SUN_UNDER_WATER || sun_state == SUN_CONNECTED) w = 0.0;
                    if (sun_state == SUN_BY_CHANCE) w = option(OPTION_CAUSTICS) ? 1.0 : 0.0;
                    arriving += frame.sun_radiance.rgb * w;
                }
                light += limited(throughput * arriving, bounce);
                break;
            }
            vec3 normal = axis_normal(hit.axis, dir);
            vec3 position = hit_point(ray, dir, hit);
            if (bounce == 0) {
                first.position_vox = position;
                first.normal = normal;
                first.distance_vox = t_entry + hit.t;
                first.material = hit.beyond == MATERIAL_AIR ? ray.medium : hit.beyond;
            }
            light += limited(throughput * materials[hit.beyond].emission_metallic.rgb, bounce);
            if (bounce >= frame.trace_options.x) break;
            v.position_vox = position;
            v.cell = hit.previous;
            v.cell_beyond = hit.cell;
            v.medium = ray.medium;
            v.beyond = hit.beyond;
            v.world_from_local = basis_around(normal);
            v.wo = -dir * v.world_from_local;
            v.surface = surface_of(hit.beyond, ray.medium);
            v.delta = is_smooth(v.surface) && (v.surface.transmissive || v.surface.metallic == 1.0);
            bool sampled = frame.trace_options.z >= LIGHT_SUN && !v.delta && sun_exists();
            stage = sampled ? STAGE_SUN : frame.trace_options.z >= LIGHT_SUN_AND_SKY && !v.delta ? STAGE_SKY : STAGE_NEXT;
        } else if (under_water_leg) {
            // Reached the surface from below: on to the sun, refracted, if it is the face that was aimed at.
            under_water_leg = false;
            vec3 n = axis_normal(hit.axis, -dir);
            bool through = hit.kind != HIT_NONE && hit.beyond == MATERIAL_AIR && hit.axis == sun_axis && dot(n, sun_leg_dir) > 0.0;
            if (through) {
                pending *= transmittance(MATERIAL_WATER, hit.t);
                ray.origin_vox = hit_point(ray, dir, hit);
                ray.cell = hit.cell;
                ray.medium = MATERIAL_AIR;
                dir = sun_leg_dir;
                continue;
            }
            ++stage;
        } else {
            if (hit.kind == HIT_NONE) light += limited(throughput * pending, bounce + 1);
            ++stage;
        }

        bool shadow_ray = false;
        while (!shadow_ray && (stage == STAGE_SUN || stage == STAGE_SUN_SIDE)) {
            vec3 wi = sample_sun(rng_vec2());
            vec3 f_cos;
            float pdf;
            pending = vec3(0.0);
            if (v.medium == MATERIAL_AIR && stage == STAGE_SUN) {
                vertex_eval(v, wi * v.world_from_local, f_cos, pdf);
                float w = frame.sun_irradiance.w > 0.0 ? power_heuristic(1.0 / frame.sun_irradiance.w, pdf) : 1.0;
                pending = f_cos * sun_sample_weight() * w;
            } else if (v.medium == MATERIAL_WATER && under_water_sampling && !v.surface.transmissive) {
                float choice = stage == STAGE_SUN ? 0.0 : rng_float();
                bool used = choice < 2.0 * SIDE_FACE_PROBABILITY;
                sun_axis = stage == STAGE_SUN ? 1 : choice < SIDE_FACE_PROBABILITY ? 0 : 2;
                vec3 face = vec3(0.0);
                face[sun_axis] = wi[sun_axis] > 0.0 ? 1.0 : -1.0;
                float cos_i = dot(wi, face);
                float eta = ior_of(MATERIAL_WATER);
                vec3 into;
                if (used && cos_i > 0.0 && refract_through(wi, face, eta, into)) {
                    vertex_eval(v, -into * v.world_from_local, f_cos, pdf);
                    // Irradiance E becomes E (1 - F) cos_i / cos_t across the beam in the water.
                    pending = f_cos * sun_sample_weight() *
                              ((1.0 - fresnel_dielectric(cos_i, eta)) * cos_i / dot(-into, face));
                    if (stage == STAGE_SUN_SIDE) pending /= SIDE_FACE_PROBABILITY;
                    sun_leg_dir = wi;
                    wi = -into;
                    under_water_leg = max_component(pending) > 0.0;
                }
            }
            shadow_ray = max_component(pending) > 0.0;
            if (shadow_ray)
                dir = wi;
            else
                ++stage;
        }
        if (!shadow_ray && stage == STAGE_SKY) {
            if (frame.trace_options.z >= LIGHT_SUN_AND_SKY && v.medium == MATERIAL_AIR && !v.surface.transmissive) {
                vec2 u = rng_vec2();
                float phi = 2.0 * PI * u.x;
                vec3 wi = vec3(sqrt(u.y) * cos(phi), sqrt(u.y) * sin(phi), sqrt(1.0 - u.y));
                vec3 f_cos;
                float pdf;
                opaque_eval(v.surface, v.wo, wi, option(OPTION_UNIFORM_DIFFUSE), f_cos, pdf);
                float sky_pdf = wi.z * INV_PI;
                vec3 to_sky = v.world_from_local * wi;
                if (sky_pdf > 0.0) pending = f_cos * sky_radiance(to_sky) * (power_heuristic(sky_pdf, pdf) / sky_pdf);
                shadow_ray = sky_pdf > 0.0 && max_component(pending) > 0.0;
                if (shadow_ray) dir = to_sky;
            }
            if (!shadow_ray) stage = STAGE_NEXT;
        }
        if (shadow_ray) {
            ray.origin_vox = v.position_vox;
            ray.cell = v.cell;
            ray.medium = v.medium;
            continue;
        }

        // STAGE_NEXT: the path goes on by the BSDF.
        vec3 u = vec3(rng_vec2(), 0.0);
        u.z = rng_float();
        BsdfSample next;
        if (v.surface.transmissive)
            next = dielectric_sample(v.surface, v.wo, u);
        else
            next = opaque_sample(v.surface, v.wo, u, option(OPTION_UNIFORM_DIFFUSE));
        throughput *= next.weight;
        if (max_component(throughput) <= 0.0) break;
        bool transmitted = next.wi.z < 0.0;
        ray.origin_vox = v.position_vox;
        ray.cell = transmitted ? v.cell_beyond : v.cell;
        ray.medium = transmitted ? v.beyond : v.medium;
        dir = normalize(v.world_from_local * next.wi);
        bool light_sampled = frame.trace_options.z >= LIGHT_SUN;
        if (next.pdf > 0.0) {
            bool reached_by_light = light_sampled && !transmitted;
            sun_state = SUN_BY_CHANCE;
            if (reached_by_light && v.medium == MATERIAL_AIR) sun_state = SUN_SAMPLED;
            if (reached_by_light && v.medium == MATERIAL_WATER && under_water_sampling && !v.surface.transmissive)
                sun_state = SUN_UNDER_WATER;
            if (!light_sampled) sun_state = SUN_SEEN;
            bool sky_sampled = frame.trace_options.z >= LIGHT_SUN_AND_SKY && v.medium == MATERIAL_AIR && !v.surface.transmissive;
            sky_pdf_last = sky_sampled ? next.wi.z * INV_PI : 0.0;
            pdf_last = next.pdf;
        } else {
            if (sun_state == SUN_UNDER_WATER && transmitted && ray.medium == MATERIAL_AIR)
                sun_state = SUN_CONNECTED;
            else if (sun_state != SUN_SEEN)
                sun_state = SUN_BY_CHANCE;
            sky_pdf_last = 0.0;
        }
        ++bounce;
        if (bounce > frame.trace_options.y) {
            // Radiance is scaled by the index squared while inside a medium; survival must not depend on it.
            float scale = ior_of(ray.medium) / eye_ior;
            float survival = min(0.95, max_component(throughput) * scale * scale);
            if (rng_float() >= survival) break;
            throughput /= survival;
        }
        stage = STAGE_PATH;
    }
    return light;
}
