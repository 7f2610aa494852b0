// Scattering at a surface, in its local frame (z the normal on wo's side): sampling, value and density.
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/materials.glsl"

// E(cos, alpha, eta) of the GGX interface of a dielectric: r; its cosine-weighted mean Eavg: g. Axes: sqrt(cos),
// roughness, (eta - 1) / (eta + 1) from -0.6 to 0.6 (src/reference/albedo.h makes it).
layout(binding = BINDING_ALBEDO_TABLE) uniform sampler3D albedo_table;

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
};

// The surface between `medium` on this side and `beyond`.
Surface surface_of(uint beyond, uint medium) {
    Material m = materials[beyond];
    Surface s;
    s.transmissive = transmits(beyond);
    s.base = m.base_roughness.rgb;
    s.metallic = m.emission_metallic.w;
    s.coated = m.absorption_ior.w != 1.0;
    s.eta = m.absorption_ior.w / ior_of(medium);
    // Between two transparent media the rougher one makes the surface; air has none of its own.
    float roughness = beyond == MATERIAL_AIR ? 0.0 : m.base_roughness.w;
    if (s.transmissive && medium != MATERIAL_AIR) roughness = max(roughness, materials[medium].base_roughness.w);
    s.alpha = roughness * roughness;
    return s;
}

bool is_smooth(Surface s) { return s.alpha < ALPHA_SMOOTH; }

vec2 albedo_lookup(float cos_w, float alpha, float eta) {
    vec3 size = vec3(textureSize(albedo_table, 0));
    vec3 at = vec3(sqrt(clamp(cos_w, 0.0, 1.0)), sqrt(alpha), ((eta - 1.0) / (eta + 1.0) + 0.6) / 1.2);
    return textureLod(albedo_table, (clamp(at, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0).rg;
}

// Reflectance of the interface at one microfacet: dielectric and metal blended.
vec3 opaque_fresnel(Surface s, float cos_h) {
    float dielectric = s.coated ? fresnel_dielectric(cos_h, s.eta) : 0.0;
    if (s.metallic == 0.0) return vec3(dielectric);
    return mix(vec3(dielectric), fresnel_schlick(cos_h, s.base), s.metallic);
}

// Factor of the Lambert base that leaves room for what the interface reflects (Kelemen & Szirmay-Kalos 2001).
float base_factor(Surface s, vec3 wo, vec3 wi) {
    if (!s.coated) return 1.0;
    vec2 out_ = albedo_lookup(wo.z, s.alpha, s.eta);
    float in_ = albedo_lookup(wi.z, s.alpha, s.eta).r;
    return (1.0 - out_.r) * (1.0 - in_) / max(1e-4, 1.0 - out_.g);
}

// Probability of sampling the interface rather than the base.
float interface_probability(Surface s, vec3 wo) {
    float e = s.coated ? albedo_lookup(wo.z, s.alpha, s.eta).r : 0.0;
    float mirror = mix(e, max_component(s.base), s.metallic);
    float diffuse = (1.0 - s.metallic) * max_component(s.base) * (1.0 - e);
    return mirror + diffuse > 0.0 ? mirror / (mirror + diffuse) : 0.0;
}

// f cos and density of an opaque surface for a given wi; the delta part of a smooth interface is left out.
void opaque_eval(Surface s, vec3 wo, vec3 wi, bool uniform_diffuse, out vec3 f_cos, out float pdf) {
    f_cos = vec3(0.0);
    pdf = 0.0;
    if (wi.z <= 0.0 || wo.z <= 0.0) return;
    float p = interface_probability(s, wo);
    f_cos = s.base * ((1.0 - s.metallic) * base_factor(s, wo, wi) * wi.z * INV_PI);
    pdf = (1.0 - p) * (uniform_diffuse ? 0.5 * INV_PI : wi.z * INV_PI);
    if (p > 0.0 && !is_smooth(s)) {
        vec3 h = normalize(wo + wi);
        float d = ggx_d(h, s.alpha);
        f_cos += opaque_fresnel(s, dot(wo, h)) * (d * ggx_g2(wo, wi, s.alpha) / (4.0 * wo.z));
        pdf += p * ggx_g1(wo, s.alpha) * d / (4.0 * wo.z);
    }
}

// u: two numbers for the direction, one for the choice of the lobe. weight 0: the path ends.
BsdfSample opaque_sample(Surface s, vec3 wo, vec3 u, bool uniform_diffuse) {
    BsdfSample result;
    float p = interface_probability(s, wo);
    if (u.z < p) {
        if (is_smooth(s)) {
            result.wi = vec3(-wo.xy, wo.z);
            result.weight = opaque_fresnel(s, wo.z) / p;
            result.pdf = 0.0;
            return result;
        }
        vec3 h = ggx_sample_visible_normal(wo, s.alpha, u.xy);
        result.wi = reflect(-wo, h);
    } else {
        float phi = 2.0 * PI * u.x;
        float z = uniform_diffuse ? u.y : sqrt(1.0 - u.y);
        float r = uniform_diffuse ? sqrt(max(0.0, 1.0 - z * z)) : sqrt(u.y);
        result.wi = vec3(r * cos(phi), r * sin(phi), z);
        // The plain Lambert surface: f cos / density is the base colour itself, with no rounding.
        if (p == 0.0) {
            result.weight = s.base * ((1.0 - s.metallic) * (uniform_diffuse ? 2.0 * z : 1.0));
            result.pdf = uniform_diffuse ? 0.5 * INV_PI : z * INV_PI;
            return result;
        }
    }
    vec3 f_cos;
    opaque_eval(s, wo, result.wi, uniform_diffuse, f_cos, result.pdf);
    result.weight = result.pdf > 0.0 ? f_cos / result.pdf : vec3(0.0);
    return result;
}

// A dielectric interface, smooth or rough (Walter et al. 2007): reflection or transmission picked by Fresnel.
// Transmitted radiance is scaled by (index here / index beyond)^2.
BsdfSample dielectric_sample(Surface s, vec3 wo, vec3 u) {
    BsdfSample result;
    result.pdf = 0.0;
    if (s.eta == 1.0) {
        result.wi = -wo;
        result.weight = vec3(1.0);
        return result;
    }
    bool smooth_ = is_smooth(s);
    vec3 h = smooth_ ? vec3(0.0, 0.0, 1.0) : ggx_sample_visible_normal(wo, s.alpha, u.xy);
    float cos_h = max(0.0, dot(wo, h));
    float f = fresnel_dielectric(cos_h, s.eta);
    bool reflected = u.z < f;
    if (reflected) {
        result.wi = reflect(-wo, h);
    } else if (!refract_through(wo, h, s.eta, result.wi)) {
        result.weight = vec3(0.0);
        return result;
    }
    bool wrong_side = reflected ? result.wi.z <= 0.0 : result.wi.z >= 0.0;
    float shadowing = smooth_ ? 1.0 : ggx_g2(wo, result.wi, s.alpha) / ggx_g1(wo, s.alpha);
    result.weight = wrong_side ? vec3(0.0) : vec3(shadowing * (reflected ? 1.0 : 1.0 / (s.eta * s.eta)));
    if (!smooth_ && !wrong_side) {
        float visible = ggx_visible_normal_pdf(wo, h, s.alpha);
        if (reflected) {
            result.pdf = f * visible / max(4.0 * cos_h, 1e-12);
        } else {
            float denominator = cos_h + s.eta * dot(result.wi, h);
            result.pdf = (1.0 - f) * visible * s.eta * s.eta * abs(dot(result.wi, h)) /
                         max(denominator * denominator, 1e-12);
        }
    }
    return result;
}

// f cos and density of a rough dielectric for a wi on wo's side.
void dielectric_eval_reflection(Surface s, vec3 wo, vec3 wi, out vec3 f_cos, out float pdf) {
    f_cos = vec3(0.0);
    pdf = 0.0;
    if (wi.z <= 0.0 || s.eta == 1.0) return;
    vec3 h = normalize(wo + wi);
    float f = fresnel_dielectric(max(0.0, dot(wo, h)), s.eta);
    float d = ggx_d(h, s.alpha);
    f_cos = vec3(f * d * ggx_g2(wo, wi, s.alpha) / (4.0 * wo.z));
    pdf = f * d * ggx_g1(wo, s.alpha) / (4.0 * wo.z);
}
