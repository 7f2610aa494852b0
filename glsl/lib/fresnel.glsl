// Reflectance of interfaces.

// Unpolarised dielectric reflectance; cos_i in [0,1] against the normal on this side, eta = index beyond / index here.
// 1 at and beyond total internal reflection; 0 for eta == 1.
float fresnel_dielectric(float cos_i, float eta) {
    if (eta == 1.0) return 0.0;
    // With g = eta cos_t and the differences of Fresnel's numerators multiplied out: no cancellation for eta near 1 or
    // near the critical angle.
    float m = (eta - 1.0) * (eta + 1.0);
    float c2 = cos_i * cos_i;
    if (m + c2 <= 0.0) return 1.0;
    float g = sqrt(m + c2);
    float eta2 = eta * eta;
    float parallel = m * ((eta2 + 1.0) * c2 - 1.0) / ((eta2 * cos_i + g) * (eta2 * cos_i + g));
    float perpendicular = m / ((cos_i + g) * (cos_i + g));
    return min(1.0, 0.5 * (parallel * parallel + perpendicular * perpendicular));
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
    float m = (eta - 1.0) * (eta + 1.0);
    float g2 = m + cos_i * cos_i;
    wi = vec3(0.0);
    if (g2 <= 0.0) return false;
    // eta wi = (cos_i - g) n - wo with g = eta cos_t.
    wi = normalize(-m / (cos_i + sqrt(g2)) * n - wo);
    return true;
}
