// Sampled pairs of directions: does the weight equal f cos / density, is the density the one that is reported for the
// direction, and is f the same backwards? Largest differences, relative, in units of what rounding of unit vectors
// allows.
#include "tests/kernels/bsdf_case.glsl"
#include "lib/rng.glsl"

layout(local_size_x = 64) in;

struct Worst {
    float weight, density, reciprocity;
    float asymmetry;  // of f as it is, not in units of rounding
    uint reflected, transmitted, ended, disagree;  // disagree: only one of sampling and density knows the direction
};

layout(std430, binding = 0) buffer WorstBlock { Worst worst[]; };

float difference(float a, float b) { return abs(a - b) / max(abs(a), abs(b)); }

// An ulp of the directions as it arrives: through the half vector and its slope over alpha, at facets seen edge-on, at
// the root of Fresnel's formula near the critical angle, in shadowing at grazing angles.
float rounding(vec3 w, vec3 wi) {
    vec3 v = wi.z > 0.0 ? w + wi : w + eta * wi;
    float h = length(v);
    float cos_o = abs(dot(w, v)) / h;
    float cos_i = abs(dot(wi, v)) / h;
    float conditioning = 8.0 + (1.0 + eta) / (h * max(alpha, 1e-3)) + 1.0 / w.z + 1.0 / abs(wi.z);
    conditioning += 1.0 / abs(eta * eta - 1.0 + cos_o * cos_o);
    if (wi.z < 0.0) {
        float edge = min(cos_o, cos_i);
        conditioning += (1.0 + eta) / (h * min(edge, abs(v.z) / h)) + 1.0 / (edge * edge);
    }
    return 1.2e-7 * conditioning;
}

void main() {
    Surface s = case_surface();
    Worst mine = Worst(0.0, 0.0, 0.0, 0.0, 0u, 0u, 0u, 0u);
    rng_seed(uvec2(gl_GlobalInvocationID.x, 0u), seed, 0u, 1u);
    for (int k = 0; k < count; ++k) {
        float z = max(1e-3, rng_float());
        float phi = 2.0 * PI * rng_float();
        vec3 w = vec3(sqrt(1.0 - z * z) * cos(phi), sqrt(1.0 - z * z) * sin(phi), z);
        vec3 u = vec3(rng_vec2(), 0.0);
        u.z = rng_float();
        BsdfSample sampled = case_sample(s, w, u);
        if (max_component(sampled.weight) <= 0.0) {
            ++mine.ended;
            continue;
        }
        vec3 f_cos;
        float pdf;
        case_eval(s, w, sampled.wi, f_cos, pdf);
        float ulp = rounding(w, sampled.wi);
        if (!(pdf > 0.0) || !(sampled.pdf > 0.0)) {
            // A facet seen edge-on, or one that stands upright, may count as hidden.
            if (ulp < 0.1) ++mine.disagree;
            continue;
        }
        mine.weight = max(mine.weight, difference(f_cos.x / pdf, sampled.weight.x) / ulp);
        mine.density = max(mine.density, difference(pdf, sampled.pdf) / ulp);

        // f without the cosine; beyond the surface it is scaled by the index squared (Walter et al. 2007).
        float forward = f_cos.x / abs(sampled.wi.z);
        Surface back = s;
        vec3 from = sampled.wi;
        vec3 to = w;
        if (sampled.wi.z < 0.0) {
            back.eta = 1.0 / eta;
            from.z = -from.z;
            to.z = -to.z;
            forward *= eta * eta;
            ++mine.transmitted;
        } else {
            ++mine.reflected;
        }
        vec3 back_cos;
        float back_pdf;
        case_eval(back, from, to, back_cos, back_pdf);
        float backward = back_cos.x / w.z;
        mine.asymmetry = max(mine.asymmetry, difference(forward, backward));
        // The compensation of metals and glass is not reciprocal, and is meant not to be; all else is.
        if (transmissive != 0) {
            forward /= glass_gain(s, w.z);
            backward /= glass_gain(back, from.z);
        } else if (metallic == 1.0) {
            forward /= coat_towards(s, w.z).metal_gain.x;
            backward /= coat_towards(s, sampled.wi.z).metal_gain.x;
        }
        mine.reciprocity = max(mine.reciprocity, difference(forward, backward) / ulp);
    }
    worst[gl_GlobalInvocationID.x] = mine;
}
