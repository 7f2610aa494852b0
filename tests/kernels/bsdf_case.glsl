// A surface and a direction from uniforms, for kernels that hold glsl/lib/bsdf.glsl as it is shipped.
#define TRACE_CLEAR 1
#define TRACE_ROUGH 1
#define TRACE_COATED 1
#include "lib/bsdf.glsl"

// As BsdfCaseBlock of tests/gpu/bsdf_case.h. A block: zink mixes up the variants that it makes of plain uniforms.
layout(std140, binding = 2) uniform CaseBlock {
    vec3 wo;
    float alpha;
    vec3 base;
    float metallic;
    float eta;
    int transmissive;
    int uniform_diffuse;
    int count;  // samples of an invocation, or points along each side of a bin
    uint seed;
    int by_slopes;  // how directions fall into bins
    float bin_alpha;
    float bin_eta;
};

Surface case_surface() {
    return Surface(base, alpha, metallic, eta, transmissive == 0 && eta != 1.0, transmissive != 0);
}

BsdfSample case_sample(Surface s, vec3 w, vec3 u) {
    return s.transmissive ? dielectric_sample(s, w, u) : opaque_sample(s, w, u, uniform_diffuse != 0);
}

void case_eval(Surface s, vec3 w, vec3 wi, out vec3 f_cos, out float pdf) {
    if (s.transmissive)
        dielectric_eval(s, w, wi, f_cos, pdf);
    else
        opaque_eval(s, w, wi, uniform_diffuse != 0, f_cos, pdf);
}
