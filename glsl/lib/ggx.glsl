// The GGX microfacet distribution with Smith's height-correlated shadowing (Walter et al. 2007, Heitz 2014), in the
// local frame whose z is the normal. alpha = roughness^2.
#include "lib/math.glsl"
#include "shared/trace.h"

// Above this alpha a reflection counts as diffuse where diffuse bounces are counted: it shows light, not a picture.
const float ALPHA_GLOSSY = 0.25;

float ggx_d(vec3 h, float alpha) {
    if (h.z <= 0.0) return 0.0;
    float a2 = alpha * alpha;
    // sin^2 from the components: 1 - z^2 cancels for the narrow lobes of small alpha.
    float s = dot(h.xy, h.xy) + a2 * h.z * h.z;
    return a2 / (PI * s * s);
}

// Smith's masking with lambda = (stretched / |cos| - 1) / 2, in forms that hold at every angle: G1 / cos of w, ...
float ggx_stretched(vec3 w, float alpha) { return sqrt(w.z * w.z + alpha * alpha * dot(w.xy, w.xy)); }

float ggx_g1_over_cos(vec3 w, float alpha) { return 2.0 / max(abs(w.z) + ggx_stretched(w, alpha), 1e-30); }

// ... G2 / cos of wo, ...
float ggx_g2_over_cos(vec3 wo, vec3 wi, float alpha) {
    float sum = ggx_stretched(wo, alpha) * abs(wi.z) + ggx_stretched(wi, alpha) * abs(wo.z);
    return 2.0 * abs(wi.z) / max(sum, 1e-30);
}

// ... and G2 / G1 of wo: the weight of what is sampled by visible normals.
float ggx_g2_over_g1(vec3 wo, vec3 wi, float alpha) {
    return ggx_g2_over_cos(wo, wi, alpha) / ggx_g1_over_cos(wo, alpha);
}

// A normal visible from wo (wo.z > 0), by spherical caps (Dupuy & Benyoub 2023). u in [0,1)^2.
vec3 ggx_sample_visible_normal(vec3 wo, float alpha, vec2 u) {
    vec3 w = normalize(vec3(wo.xy * alpha, wo.z));
    float phi = 2.0 * PI * u.x;
    float z = (1.0 - u.y) * (1.0 + w.z) - w.z;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + w;
    return normalize(vec3(h.xy * alpha, max(h.z, 1e-12)));
}
