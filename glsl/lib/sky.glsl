// Light from beyond the world: one function for every miss.
#include "shared/frame.h"
#include "lib/math.glsl"
#include "lib/options.glsl"

// The clear sky of Preetham, Shirley & Smits 1999 (src/app/clear_sky.h). Below the horizon it goes on as on it; the
// angle to the sun grows to a right angle straight down, so that no point sticks out.
vec3 clear_sky_radiance(vec3 dir) {
    vec3 d = vec3(dir.x, max(dir.y, 0.0), dir.z);
    vec3 sun = frame.sky_sun_dir.xyz;
    float gamma = 2.0 * atan(length(d - sun), length(d + sun));
    float cos_gamma = cos(gamma);
    vec3 around_zenith = 1.0 + frame.sky_perez_a.xyz * exp(frame.sky_perez_b.xyz / max(d.y, 1e-3));
    vec3 around_sun = 1.0 + frame.sky_perez_c.xyz * exp(frame.sky_perez_d.xyz * gamma) +
                      frame.sky_perez_e.xyz * (cos_gamma * cos_gamma);
    vec3 c = frame.sky_perez_scale.xyz * around_zenith * around_sun;  // Y, x, y
    vec3 xyz = vec3(c.y, c.z, 1.0 - c.y - c.z) * (c.x / c.z);
    const mat3 to_srgb = mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570);
    return max(to_srgb * xyz, vec3(0.0)) + frame.sky_night.rgb;
}

// Asked for at run time: compiled in or out, it makes no difference that can be measured.
vec3 sky_radiance(vec3 dir) {
    if (option(OPTION_PREETHAM_SKY)) return clear_sky_radiance(dir);
    return mix(frame.sky_horizon.rgb, frame.sky_zenith.rgb, max(0.0, dir.y));
}

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
