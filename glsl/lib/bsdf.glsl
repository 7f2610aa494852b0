// Scattering at a surface, in its local frame (z the normal on wo's side): sampling, value and density.
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/materials.glsl"

#ifdef TRACE_COATED
// E(cos, alpha, eta) of the GGX interface of a dielectric: r; its cosine-weighted mean Eavg: g. Axes: sqrt(cos),
// roughness, x of ALBEDO_ETA_RANGE (src/reference/albedo.h makes it).
layout(binding = BINDING_ALBEDO_TABLE) uniform sampler3D albedo_table;
#endif

struct Surface {
    vec3 base;
    float alpha;
    float metallic;
    float eta;         // index beyond / index here
    bool coated;       // opaque: a GGX interface over the Lambert base
    bool transmissive;
};

struct BsdfSample {
    vec3 wi;       // z < 0: beyond the surface
    vec3 weight;   // f cos / density
    float pdf;     // per solid angle; 0 for a delta direction
    bool diffuse;  // from a Lambert base or a rough interface, not from a mirror or a clear surface
};

// The surface between `medium` (of index `medium_ior`) on this side and `id` beyond, whose properties are `m`.
Surface surface_of(Material m, uint id, uint medium, float medium_ior) {
    Surface s;
    s.transmissive = transmits(id);
    s.base = m.base_roughness.rgb;
    s.metallic = m.emission_metallic.w;
    s.coated = m.absorption_ior.w != 1.0;
    s.eta = m.absorption_ior.w / medium_ior;
    float roughness = m.base_roughness.w;
#ifdef TRACE_CLEAR
    // Between two clear media the rougher one makes the surface; air has none of its own.
    if (id == MATERIAL_AIR) roughness = 0.0;
#ifdef TRACE_ROUGH
    if (s.transmissive && medium != MATERIAL_AIR) roughness = max(roughness, materials[medium].base_roughness.w);
#endif
#endif
    s.alpha = roughness * roughness;
    return s;
}

bool is_smooth(Surface s) { return s.alpha < ALPHA_SMOOTH; }

#ifdef TRACE_COATED
vec2 albedo_lookup(float cos_w, float alpha, float eta) {
    vec3 size = vec3(textureSize(albedo_table, 0));
    float s = (eta - 1.0) / (eta + 1.0);
    float x = sign(s) * sqrt(abs(s) / ALBEDO_ETA_RANGE);
    vec3 at = vec3(sqrt(clamp(cos_w, 0.0, 1.0)), sqrt(alpha), 0.5 * x + 0.5);
    vec2 albedo = textureLod(albedo_table, (clamp(at, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0).rg;
    // A smooth interface needs no table, and between its samples near grazing the table errs most.
    if (alpha < ALPHA_SMOOTH) albedo.r = fresnel_dielectric(cos_w, eta);
    return albedo;
}

// Reflectance of the interface at one microfacet: dielectric and metal blended.
vec3 opaque_fresnel(Surface s, float cos_h) {
    float dielectric = s.coated ? fresnel_dielectric(cos_h, s.eta) : 0.0;
    return mix(vec3(dielectric), fresnel_schlick(cos_h, s.base), s.metallic);
}

// Value and density of a direction, given E of the direction to the eye (albedo_o) and the probability of sampling
// the interface. The base is Lambert, less what the interface reflects of it (Kelemen & Szirmay-Kalos 2001).
void coated_eval(Surface s, vec3 wo, vec3 wi, bool uniform_diffuse, vec2 albedo_o, float p, out vec3 f_cos,
                 out float pdf) {
    float room = 1.0;
    if (s.coated)
        room = (1.0 - albedo_o.r) * (1.0 - albedo_lookup(wi.z, s.alpha, s.eta).r) / max(1e-4, 1.0 - albedo_o.g);
    f_cos = s.base * ((1.0 - s.metallic) * room * wi.z * INV_PI);
    pdf = (1.0 - p) * (uniform_diffuse ? 0.5 * INV_PI : wi.z * INV_PI);
    if (p > 0.0 && !is_smooth(s)) {
        vec3 h = normalize(wo + wi);
        float d = ggx_d(h, s.alpha);
        f_cos += opaque_fresnel(s, dot(wo, h)) * (d * ggx_g2(wo, wi, s.alpha) / (4.0 * wo.z));
        pdf += p * ggx_g1(wo, s.alpha) * d / (4.0 * wo.z);
    }
    if (wi.z <= 0.0 || wo.z <= 0.0) {
        f_cos = vec3(0.0);
        pdf = 0.0;
    }
}

// Probability of sampling the interface rather than the base.
float interface_probability(Surface s, float albedo_o) {
    float mirror = mix(albedo_o, max_component(s.base), s.metallic);
    float diffuse = (1.0 - s.metallic) * max_component(s.base) * (1.0 - albedo_o);
    return mirror + diffuse > 0.0 ? mirror / (mirror + diffuse) : 0.0;
}

vec2 albedo_towards(Surface s, float cos_w) { return s.coated ? albedo_lookup(cos_w, s.alpha, s.eta) : vec2(0.0); }
#endif

// f cos and density of an opaque surface for a given wi; the delta part of a smooth interface is left out.
void opaque_eval(Surface s, vec3 wo, vec3 wi, bool uniform_diffuse, out vec3 f_cos, out float pdf) {
#ifdef TRACE_COATED
    vec2 albedo_o = albedo_towards(s, wo.z);
    coated_eval(s, wo, wi, uniform_diffuse, albedo_o, interface_probability(s, albedo_o.r), f_cos, pdf);
#else
    float cos_i = max(0.0, wi.z);
    f_cos = s.base * (cos_i * INV_PI);
    pdf = uniform_diffuse ? (wi.z > 0.0 ? 0.5 * INV_PI : 0.0) : cos_i * INV_PI;
#endif
}

// u: two numbers for the direction, one for the choice of the lobe. weight 0: the path ends.
BsdfSample opaque_sample(Surface s, vec3 wo, vec3 u, bool uniform_diffuse) {
    BsdfSample result;
    float phi = 2.0 * PI * u.x;
    float z = uniform_diffuse ? u.y : sqrt(1.0 - u.y);
    float r = uniform_diffuse ? sqrt(max(0.0, 1.0 - z * z)) : sqrt(u.y);
    // The plain Lambert surface: f cos / density is the base colour itself, with no rounding.
    result.wi = vec3(r * cos(phi), r * sin(phi), z);
    result.weight = s.base * (uniform_diffuse ? 2.0 * z : 1.0);
    result.pdf = uniform_diffuse ? 0.5 * INV_PI : z * INV_PI;
    result.diffuse = true;
#ifdef TRACE_COATED
    vec2 albedo_o = albedo_towards(s, wo.z);
    float p = interface_probability(s, albedo_o.r);
    if (p > 0.0) {
        bool mirror = u.z < p;
        result.diffuse = !mirror || s.alpha > ALPHA_GLOSSY;
        if (mirror && is_smooth(s)) {
            result.wi = vec3(-wo.xy, wo.z);
            result.weight = opaque_fresnel(s, wo.z) / p;
            result.pdf = 0.0;
        } else {
            if (mirror) result.wi = reflect(-wo, ggx_sample_visible_normal(wo, s.alpha, u.xy));
            vec3 f_cos;
            coated_eval(s, wo, result.wi, uniform_diffuse, albedo_o, p, f_cos, result.pdf);
            result.weight = result.pdf > 0.0 ? f_cos / result.pdf : vec3(0.0);
        }
    }
#endif
    return result;
}

#ifdef TRACE_CLEAR
// A dielectric interface, smooth or rough (Walter et al. 2007): reflection or transmission picked by Fresnel.
// Transmitted radiance is scaled by (index here / index beyond)^2.
BsdfSample dielectric_sample(Surface s, vec3 wo, vec3 u) {
    BsdfSample result;
    result.pdf = 0.0;
    result.diffuse = s.alpha > ALPHA_GLOSSY;
    vec3 h = vec3(0.0, 0.0, 1.0);
#ifdef TRACE_ROUGH
    bool rough = !is_smooth(s) && s.eta != 1.0;
    if (rough) h = ggx_sample_visible_normal(wo, s.alpha, u.xy);
#endif
    float cos_h = max(0.0, dot(wo, h));
    float f = fresnel_dielectric(cos_h, s.eta);
    bool reflected = u.z < f;
    vec3 refracted;
    bool passes = refract_through(wo, h, s.eta, refracted);
    result.wi = reflected ? reflect(-wo, h) : refracted;
    result.weight = vec3(reflected ? 1.0 : passes ? 1.0 / (s.eta * s.eta) : 0.0);
#ifdef TRACE_ROUGH
    if (rough) {
        bool wrong_side = reflected ? result.wi.z <= 0.0 : result.wi.z >= 0.0;
        result.weight *= wrong_side ? 0.0 : ggx_g2(wo, result.wi, s.alpha) / ggx_g1(wo, s.alpha);
        float visible = ggx_visible_normal_pdf(wo, h, s.alpha);
        float cos_t = abs(dot(result.wi, h));
        float denominator = cos_h - s.eta * cos_t;
        result.pdf = reflected ? f * visible / max(4.0 * cos_h, 1e-12)
                               : (1.0 - f) * visible * s.eta * s.eta * cos_t / max(denominator * denominator, 1e-12);
    }
#endif
    return result;
}
#endif

#ifdef TRACE_ROUGH
// f cos and density of a rough dielectric for a wi on wo's side.
void dielectric_eval_reflection(Surface s, vec3 wo, vec3 wi, out vec3 f_cos, out float pdf) {
    vec3 h = normalize(wo + wi);
    float f = fresnel_dielectric(clamp(dot(wo, h), 0.0, 1.0), s.eta);
    float d = ggx_d(h, s.alpha);
    bool valid = wi.z > 0.0 && wo.z > 0.0 && s.eta != 1.0;
    f_cos = vec3(valid ? f * d * ggx_g2(wo, wi, s.alpha) / (4.0 * wo.z) : 0.0);
    pdf = valid ? f * d * ggx_g1(wo, s.alpha) / (4.0 * wo.z) : 0.0;
}
#endif
