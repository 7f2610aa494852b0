// Reflectance and refracted direction for each index and cosine of a list.
#include "lib/fresnel.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer ResultBlock { vec4 results[]; };  // reflectance, x and z of wi, passes
layout(std430, binding = 1) readonly buffer InputBlock { vec4 inputs[]; };     // wo.x, wo.z, eta

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(inputs.length())) return;
    vec3 wi;
    bool passes = refract_through(vec3(inputs[i].x, 0.0, inputs[i].y), vec3(0.0, 0.0, 1.0), inputs[i].z, wi);
    results[i] = vec4(fresnel_dielectric(inputs[i].y, inputs[i].z), wi.x, wi.z, passes ? 1.0 : 0.0);
}
