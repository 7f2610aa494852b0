// Light that crosses a level water surface once between two points: where it crosses (Snell's law, by Newton's method),
// and how an area at its end spreads over the solid angle at its start.
#include "lib/fresnel.glsl"
#include "lib/materials.glsl"
#include "lib/traversal.glsl"

const float NO_SURFACE = -1e9;

// Steps of Newton's method. It starts below the root of a concave function and never passes it.
const int CROSSING_STEPS = 8;

struct Crossing {
    vec3 at_vox;
    float transmittance;   // 1 - F
    float area_per_angle;  // across the light's direction at its end (vox^2), per solid angle at its start
};

// Height of the surface straight above a point under water; NO_SURFACE where something else lies there.
float surface_above(RayStart under) {
    vec3 up = vec3(0.0, 1.0, 0.0);
    RayHit hit = trace_ray(under, up, frame.trace_limits.x);
    bool found = hit.kind != HIT_NONE && hit.beyond == MATERIAL_AIR;
    return found ? hit_point(under, up, hit).y : NO_SURFACE;
}

// Between `from` and `to` on the two sides of the plane at `height`.
Crossing cross_surface(vec3 from, float ior_from, vec3 to, float ior_to, float height) {
    float below = abs(from.y - height);
    float beyond = abs(to.y - height);
    vec2 across = to.xz - from.xz;
    float r = length(across);
    // r = rare t + dense t / sqrt(m^2 + (m^2 - 1) t^2), t the tangent of the angle in the rarer medium.
    bool from_dense = ior_from > ior_to;
    float dense = from_dense ? below : beyond;
    float rare = from_dense ? beyond : below;
    float m = max(ior_from, ior_to) / min(ior_from, ior_to);
    float m2 = m * m;
    float t = r / max(rare + dense / m, 1e-12);
    float q = m2 + (m2 - 1.0) * t * t;
    for (int i = 0; i < CROSSING_STEPS; ++i) {
        float slope = rare + dense * m2 / (q * sqrt(q));
        t -= (t * (rare + dense / sqrt(q)) - r) / max(slope, 1e-12);
        q = m2 + (m2 - 1.0) * t * t;
    }
    float tan_from = from_dense ? t / sqrt(q) : t;
    float tan_to = from_dense ? t : t / sqrt(q);
    float cos_from = inversesqrt(1.0 + tan_from * tan_from);
    float cos_to = inversesqrt(1.0 + tan_to * tan_to);
    float eta = ior_to / ior_from;
    Crossing crossing;
    vec2 shift = r > 0.0 ? across * min(below * tan_from / r, 1.0) : vec2(0.0);
    crossing.at_vox = vec3(from.x + shift.x, height, from.z + shift.y);
    crossing.transmittance = 1.0 - fresnel_dielectric(cos_from, eta);
    // r dr / (sin(a) da), a the angle at the start.
    float ring = below / cos_from + beyond / (eta * cos_to);
    float spread = below / (cos_from * cos_from) + beyond * cos_from / (eta * cos_to * cos_to * cos_to);
    crossing.area_per_angle = ring * spread * cos_to;
    return crossing;
}
