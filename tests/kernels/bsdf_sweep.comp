// Every input at its limits: counts what is not finite, negative, or of a wrong length. An invocation takes one
// direction wo and one roughness; the surface's other properties are those of the case.
#include "tests/kernels/bsdf_case.glsl"

layout(local_size_x = 64) in;

const float COSINES[16] = float[](1e-38, 1e-30, 1e-20, 1e-12, 1e-8, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9,
                                  0.99999994, 1.0);
const float ALPHAS[12] = float[](0.0, 1e-30, 1e-8, 9.999e-4, 1e-3, 1.0001e-3, 0.01, 0.1, 0.25, 0.5, 0.99999994, 1.0);
const float NUMBERS[6] = float[](0.0, 5.9604645e-8, 0.25, 0.5, 0.75, 0.99999994);
const float AZIMUTHS[6] = float[](0.0, 1e-4, 1.0, 1.5707964, 3.1415925, 3.1415927);

struct Faults {
    uint samples, values;
    uint bad_samples, bad_values;
    vec4 sample_input;  // of the last fault: cos of wo, alpha, u.x + 2 u.y, u.z
    vec4 value_input;   // cos of wo, alpha, cos of wi, azimuth of wi
};

layout(std430, binding = 0) buffer FaultBlock { Faults faults[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    float cos_o = COSINES[i % 16u];
    vec3 w = vec3(sqrt(1.0 - cos_o * cos_o), 0.0, cos_o);
    Surface s = case_surface();
    s.alpha = ALPHAS[(i / 16u) % 12u];
    Faults mine = Faults(0u, 0u, 0u, 0u, vec4(0.0), vec4(0.0));
    for (int k = 0; k < 216; ++k) {
        vec3 u = vec3(NUMBERS[k % 6], NUMBERS[(k / 6) % 6], NUMBERS[k / 36]);
        BsdfSample sampled = case_sample(s, w, u);
        bool ends = max_component(sampled.weight) <= 0.0;
        bool good = is_finite(sampled.weight) && is_finite(sampled.wi) && is_finite(sampled.pdf) &&
                    min(sampled.weight.x, sampled.pdf) >= 0.0 &&
                    (ends || abs(dot(sampled.wi, sampled.wi) - 1.0) < 1e-5);
        ++mine.samples;
        if (!good) {
            ++mine.bad_samples;
            mine.sample_input = vec4(cos_o, s.alpha, u.x + 2.0 * u.y, u.z);
        }
    }
    for (int k = 0; k < 16 * 6 * 2; ++k) {
        float z = COSINES[k % 16];
        float phi = AZIMUTHS[(k / 16) % 6];
        float r = sqrt(1.0 - z * z);
        vec3 wi = vec3(r * cos(phi), r * sin(phi), k < 16 * 6 ? z : -z);
        // Exactly mirrored and exactly opposite directions.
        if (phi == 0.0 && z == cos_o) wi = k < 16 * 6 ? w : -w;
        vec3 f_cos;
        float pdf;
        case_eval(s, w, wi, f_cos, pdf);
        ++mine.values;
        if (!(is_finite(f_cos) && is_finite(pdf) && min(f_cos.x, pdf) >= 0.0)) {
            ++mine.bad_values;
            mine.value_input = vec4(cos_o, s.alpha, wi.z, phi);
        }
    }
    faults[i] = mine;
}
