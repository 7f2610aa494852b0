// Reflectance of interfaces.

// Unpolarised dielectric reflectance; cos_i in [0,1] against the normal on this side, eta = index beyond / index here.
// 1 at and beyond total internal reflection; 0 for eta == 1.
float fresnel_dielectric(float cos_i, float eta) {
    if (eta == 1.0) return 0.0;
    float sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1.0) return 1.0;
    float cos_t = sqrt(1.0 - sin2_t);
    float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// Schlick 1994, for metals only.
vec3 fresnel_schlick(float cos_i, vec3 f0) {
    float m = clamp(1.0 - cos_i, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (1.0 - f0) * (m2 * m2 * m);
}

// Direction beyond the interface; wo is unit, away from it on this side, n on wo's side; false: total internal
// reflection. eta = index beyond / index here.
bool refract_through(vec3 wo, vec3 n, float eta, out vec3 wi) {
    float cos_i = dot(wo, n);
    float sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
    wi = vec3(0.0);
    if (sin2_t >= 1.0) return false;
    float cos_t = sqrt(max(0.0, 1.0 - sin2_t));
    wi = normalize((cos_i / eta - cos_t) * n - wo / eta);
    return true;
}
