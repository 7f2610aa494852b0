// Light from beyond the world: one function for every miss.
#include "shared/frame.h"
#include "lib/math.glsl"

vec3 sky_radiance(vec3 dir) { return mix(frame.sky_horizon.rgb, frame.sky_zenith.rgb, max(0.0, dir.y)); }

// By the squared distance of unit vectors, 2 (1 - cos): a cosine near 1 has no digits left for a small disc.
bool in_sun_disc(vec3 dir) {
    vec3 d = dir - frame.sun_dir.xyz;
    return frame.sun_irradiance.w > 0.0 && dot(d, d) <= 2.0 * frame.sun_dir.w;
}

// A direction to the sun, uniform over its disc; u in [0,1)^2.
vec3 sample_sun(vec2 u) {
    if (frame.sun_irradiance.w <= 0.0) return frame.sun_dir.xyz;
    float versine = u.x * frame.sun_dir.w;
    float r = sqrt(max(0.0, versine * (2.0 - versine)));
    float phi = 2.0 * PI * u.y;
    return normalize(basis_around(frame.sun_dir.xyz) * vec3(r * cos(phi), r * sin(phi), 1.0 - versine));
}

// Radiance over density of a sample_sun direction; for a point sun the irradiance.
vec3 sun_sample_weight() {
    return frame.sun_irradiance.w > 0.0 ? frame.sun_radiance.rgb * frame.sun_irradiance.w : frame.sun_irradiance.rgb;
}
