// glsl/lib/bsdf.glsl under test: means over samples of one opaque surface.
#define TRACE_CLEAR 1
#define TRACE_ROUGH 1
#define TRACE_COATED 1
#include "lib/bsdf.glsl"
#include "lib/rng.glsl"

layout(local_size_x = 64) in;

uniform vec3 wo;
uniform float alpha;
uniform float metallic;
uniform float base;
uniform float eta;
uniform uint per_invocation;

struct Sums {
    vec4 weight_dir;  // xyz: sum of weight * wi; w: sum of weights
    vec4 squares;     // x: of the weights; y: samples that are not finite
};

layout(std430, binding = 0) buffer ResultBlock { Sums sums[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    Surface s;
    s.base = vec3(base);
    s.alpha = alpha;
    s.metallic = metallic;
    s.eta = eta;
    s.coated = eta != 1.0;
    s.transmissive = false;
    rng_seed(uvec2(i, 0u), 3u, 1u, 9u);
    Sums mine = Sums(vec4(0.0), vec4(0.0));
    for (uint k = 0u; k < per_invocation; ++k) {
        vec3 u = vec3(rng_vec2(), 0.0);
        u.z = rng_float();
        BsdfSample sampled = opaque_sample(s, wo, u, false);
        if (!is_finite(sampled.weight) || !is_finite(sampled.wi)) {
            mine.squares.y += 1.0;
            continue;
        }
        mine.weight_dir += vec4(sampled.wi, 1.0) * sampled.weight.x;
        mine.squares.x += sampled.weight.x * sampled.weight.x;
    }
    sums[i] = mine;
}
