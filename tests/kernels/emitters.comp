// lib/emitters.glsl under test: samples of one receiver, each against the density asked for again, and the
// mean of 1 / density: the solid angle of all that shines.
#define TRAVERSAL_SKIP 1
#include "lib/emitters.glsl"

layout(local_size_x = 64) in;

uniform vec3 at_vox;
uniform int axis;
uniform float side;
uniform uint per_invocation;

struct Sums {
    vec4 sums;  // 1 / pdf, its square, samples without light, worst relative difference of the densities
};

layout(std430, binding = 0) buffer ResultBlock { Sums results[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    rng_seed(uvec2(i, 0u), 7u, 1u, 3u);
    Receiver to = Receiver(at_vox, axis, side);
    vec4 sums = vec4(0.0);
    for (uint k = 0u; k < per_invocation; ++k) {
        EmitterSample s = sample_emitter(to);
        if (s.pdf <= 0.0) {
            sums.z += 1.0;
            continue;
        }
        bool ahead = side * (s.point_vox[axis] - at_vox[axis]) > 0.0;
        float weight = ahead ? 1.0 / pdf_of_direction(s.pdf, at_vox, s.point_vox, s.axis) : 0.0;
        sums += vec4(weight, weight * weight, 0.0, 0.0);
        sums.w = max(sums.w, abs(emitter_pdf(to, s.cell, s.axis) / s.pdf - 1.0));
    }
    results[i].sums = sums;
}
