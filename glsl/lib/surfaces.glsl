// The four buffers of a frame as later passes read them: colour, normal, coordinate of the first hit, material.
#include "lib/math.glsl"
#include "lib/materials.glsl"

const uint SURFACE_SKY_ID = 255u;

// Colour that the filter divides out, so that it blurs light and not texture; 1 where the surface only transmits.
vec3 demodulation(uint material) {
    if (material == SURFACE_SKY_ID || transmits(material)) return vec3(1.0);
    return max(materials[material].base_roughness.rgb, vec3(0.02));
}
