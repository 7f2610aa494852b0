// The table of materials on the GPU, by material id.
#include "shared/materials.h"
#include "shared/bindings.h"
#include "lib/math.glsl"

struct Material {
    vec4 base_roughness;    // base_color, roughness
    vec4 absorption_ior;    // per metre, ior
    vec4 emission_metallic; // radiance, metallic
};

layout(std140, binding = BINDING_MATERIALS) uniform MaterialBlock { Material materials[MATERIAL_COUNT]; };

bool transmits(uint medium) { return medium == MATERIAL_AIR || medium == MATERIAL_WATER || medium == MATERIAL_GLASS; }

bool emits(uint id) { return max_component(materials[id].emission_metallic.rgb) > 0.0; }

float ior_of(uint medium) { return materials[medium].absorption_ior.w; }

vec3 absorption_per_m(uint medium) { return materials[medium].absorption_ior.xyz; }
