// Scattering at a surface, in its local frame (z the normal on wo's side): sampling, value and density.
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/materials.glsl"

// Nearer to grazing than this nothing scatters: half vectors have no digits left.
const float COS_GRAZING = 1e-12;

#ifdef TRACE_COATED
// E(cos, alpha, eta) of the GGX interface of a dielectric: r, for eta >= 1 less a reflectance of Fresnel; its
// cosine-weighted mean Eavg: g. Axes: sqrt(cos), or that of metals for eta >= 1; roughness; x of ALBEDO_ETA_RANGE
// (src/reference/albedo.h makes it).
layout(binding = BINDING_ALBEDO_TABLE) uniform sampler3D albedo_table;

// Ess(cos, alpha): the part that a GGX interface of reflectance 1 reflects after one scattering. Axes: angle_axis(),
// roughness.
layout(binding = BINDING_METAL_ALBEDO_TABLE) uniform sampler2D metal_albedo_table;
#endif

#ifdef TRACE_ROUGH
// The part that rough glass reflects and transmits after one scattering. Axes: angle_axis(), roughness, eta_axis().
layout(binding = BINDING_GLASS_ALBEDO_TABLE) uniform sampler3D glass_albedo_table;
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
    s.metallic = 0.0;
#ifdef TRACE_COATED
    s.metallic = m.emission_metallic.w;
#endif
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

// Axes of the tables.
float angle_axis(float cos_w, float alpha) {
    float root = sqrt(cos_w);
    float roughness = sqrt(max(alpha, ALPHA_SMOOTH));
    return root * (1.0 + roughness) / (root + roughness);
}

float eta_axis(float eta) {
    float s = (eta - 1.0) / (eta + 1.0);
    return 0.5 + 0.5 * sign(s) * sqrt(sqrt(abs(s) / ALBEDO_ETA_RANGE));
}

#ifdef TRACE_COATED
vec2 albedo_lookup(float cos_w, float alpha, float eta) {
    vec3 size = vec3(textureSize(albedo_table, 0));
    float c = clamp(cos_w, 0.0, 1.0);
    vec3 at = vec3(eta >= 1.0 ? angle_axis(c, alpha) : sqrt(c), sqrt(alpha), eta_axis(eta));
    vec2 albedo = textureLod(albedo_table, (clamp(at, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0).rg;
    // A smooth interface needs no table.
    bool smooth_one = alpha < ALPHA_SMOOTH;
    float a2 = alpha * alpha;
    float facet = smooth_one ? c : sqrt((c * c + ALBEDO_FACET_SPREAD * a2 * (1.0 - c * c)) / (1.0 + a2));
    float f = fresnel_dielectric(min(facet, 1.0), eta);
    if (smooth_one || eta >= 1.0) albedo.r = f + (smooth_one ? 0.0 : albedo.r);
    return vec2(clamp(albedo.r, 0.0, 1.0), albedo.g);
}

#ifdef TRACE_COATED
float metal_albedo_lookup(float cos_w, float alpha) {
    vec2 size = vec2(textureSize(metal_albedo_table, 0));
    vec2 at = vec2(angle_axis(clamp(cos_w, 0.0, 1.0), alpha), sqrt(alpha));
    float albedo = textureLod(metal_albedo_table, (clamp(at, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0).r;
    return alpha < ALPHA_SMOOTH ? 1.0 : albedo;
}
#endif

// What scattering at an opaque surface needs to know of wo alone.
struct Coat {
    vec2 albedo;        // E(wo), Eavg of the dielectric interface; 0 where there is none
    vec3 metal_gain;    // light scattered more than once between a metal's facets, as a factor on what scatters once
    float probability;  // of sampling the interface rather than the base
};

Coat coat_towards(Surface s, float cos_o) {
    Coat coat;
    coat.albedo = s.coated ? albedo_lookup(cos_o, s.alpha, s.eta) : vec2(0.0);
    coat.metal_gain = vec3(1.0);
#ifdef TRACE_COATED
    // Turquin 2019. Of wo only: the furnace is kept, reciprocity is not.
    coat.metal_gain += s.base * (1.0 / metal_albedo_lookup(cos_o, s.alpha) - 1.0);
#endif
    float mirror = mix(coat.albedo.r, max_component(s.base), s.metallic);
    float diffuse = (1.0 - s.metallic) * max_component(s.base) * (1.0 - coat.albedo.r);
    coat.probability = mirror + diffuse > 0.0 ? mirror / (mirror + diffuse) : 0.0;
    return coat;
}

// Reflectance of the interface at one microfacet: dielectric and metal blended.
vec3 opaque_fresnel(Surface s, Coat coat, float cos_h) {
    float dielectric = s.coated ? fresnel_dielectric(cos_h, s.eta) : 0.0;
    return mix(vec3(dielectric), fresnel_schlick(cos_h, s.base) * coat.metal_gain, s.metallic);
}

// Value and density of a direction. The base is Lambert, less what the interface reflects of it (Kelemen &
// Szirmay-Kalos 2001).
void coated_eval(Surface s, Coat coat, vec3 wo, vec3 wi, bool uniform_diffuse, out vec3 f_cos, out float pdf) {
    float p = coat.probability;
    float room = 1.0;
    if (s.coated) {
        float albedo_i = albedo_lookup(wi.z, s.alpha, s.eta).r;
        room = (1.0 - coat.albedo.r) * (1.0 - albedo_i) / max(1e-4, 1.0 - coat.albedo.g);
    }
    f_cos = s.base * ((1.0 - s.metallic) * room * wi.z * INV_PI);
    pdf = (1.0 - p) * (uniform_diffuse ? 0.5 * INV_PI : wi.z * INV_PI);
    if (p > 0.0 && !is_smooth(s)) {
        vec3 h = normalize(wo + wi);
        float d = ggx_d(h, s.alpha);
        f_cos += opaque_fresnel(s, coat, dot(wo, h)) * (0.25 * d * ggx_g2_over_cos(wo, wi, s.alpha));
        pdf += p * 0.25 * d * ggx_g1_over_cos(wo, s.alpha);
    }
    if (min(wi.z, wo.z) < COS_GRAZING) {
        f_cos = vec3(0.0);
        pdf = 0.0;
    }
}
#endif

// f cos and density of an opaque surface for a given wi; the delta part of a smooth interface is left out.
void opaque_eval(Surface s, vec3 wo, vec3 wi, bool uniform_diffuse, out vec3 f_cos, out float pdf) {
#ifdef TRACE_COATED
    coated_eval(s, coat_towards(s, wo.z), wo, wi, uniform_diffuse, f_cos, pdf);
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
    Coat coat = coat_towards(s, wo.z);
    if (coat.probability > 0.0) {
        bool mirror = u.z < coat.probability;
        result.diffuse = !mirror || s.alpha > ALPHA_GLOSSY;
        if (mirror && is_smooth(s)) {
            result.wi = vec3(-wo.xy, wo.z);
            result.weight = opaque_fresnel(s, coat, wo.z) / coat.probability;
            result.pdf = 0.0;
        } else {
            if (mirror) result.wi = reflect(-wo, ggx_sample_visible_normal(wo, s.alpha, u.xy));
            vec3 f_cos;
            coated_eval(s, coat, wo, result.wi, uniform_diffuse, f_cos, result.pdf);
            result.weight = result.pdf > 0.0 ? f_cos / result.pdf : vec3(0.0);
        }
    }
#endif
    return result;
}

#ifdef TRACE_ROUGH
// What scatters more than once goes where the rest goes (Turquin 2019): a factor on f.
float glass_gain(Surface s, float cos_o) {
    vec3 size = vec3(textureSize(glass_albedo_table, 0));
    vec3 at = vec3(angle_axis(clamp(cos_o, 0.0, 1.0), s.alpha), sqrt(s.alpha), eta_axis(s.eta));
    return 1.0 / textureLod(glass_albedo_table, (clamp(at, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0).r;
}

// f cos and density of a rough dielectric for a pair of directions and the facet normal h (h.z > 0) that turns one into
// the other (Walter et al. 2007, eq. 20 and 21). Transmitted radiance is scaled by (index here / index beyond)^2.
void dielectric_eval_at(Surface s, vec3 wo, vec3 wi, vec3 h, out vec3 f_cos, out float pdf) {
    bool reflects = wi.z > 0.0;
    float cos_o = dot(wo, h);
    float cos_i = dot(wi, h);
    float f = fresnel_dielectric(clamp(cos_o, 0.0, 1.0), s.eta);
    // By Snell's law eta |cos_i| - cos_o = (eta^2 - 1) / (eta |cos_i| + cos_o): no cancellation for eta near 1.
    float stretch = (cos_o - s.eta * cos_i) / ((s.eta - 1.0) * (s.eta + 1.0));
    float facets = reflects ? 0.25 * f : (1.0 - f) * cos_o * -cos_i * stretch * stretch;
    facets *= ggx_d(h, s.alpha);
    bool valid = min(wo.z, abs(wi.z)) >= COS_GRAZING && cos_o > 0.0 && (reflects ? cos_i > 0.0 : cos_i < 0.0) &&
                 s.eta != 1.0 && !is_smooth(s);
    f_cos = vec3(valid ? facets * ggx_g2_over_cos(wo, wi, s.alpha) * glass_gain(s, wo.z) : 0.0);
    pdf = valid ? facets * ggx_g1_over_cos(wo, s.alpha) * (reflects ? 1.0 : s.eta * s.eta) : 0.0;
}

// The same for given directions; wi on either side.
void dielectric_eval(Surface s, vec3 wo, vec3 wi, out vec3 f_cos, out float pdf) {
    vec3 h = normalize(wo + (wi.z > 0.0 ? 1.0 : s.eta) * wi);
    dielectric_eval_at(s, wo, wi, h.z < 0.0 ? -h : h, f_cos, pdf);
}
#endif

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
        vec3 f_cos;
        dielectric_eval_at(s, wo, result.wi, h, f_cos, result.pdf);
        // f cos / density without D, which is large for small alpha.
        result.weight *= result.pdf > 0.0 ? ggx_g2_over_g1(wo, result.wi, s.alpha) * glass_gain(s, wo.z) : 0.0;
    }
#endif
    return result;
}
#endif
