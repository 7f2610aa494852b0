// Energy that a GGX interface reflects and transmits after one scattering, by quadrature in double precision
// over the slopes of its facets: unlike src/reference/albedo.h and the shaders, without visible normals.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tarn {

// Unpolarised, in the form without a refracted cosine (Walter et al. 2007, eq. 22).
inline double exact_fresnel(double cos_i, double eta) {
    const double g2 = eta * eta - 1 + cos_i * cos_i;
    if (g2 <= 0) return 1;
    const double g = std::sqrt(g2);
    const double a = (g - cos_i) / (g + cos_i);
    const double b = (cos_i * (g + cos_i) - 1) / (cos_i * (g - cos_i) + 1);
    return a * a * (1 + b * b) / 2;
}

struct Energy {
    double reflected = 0;
    double transmitted = 0;
};

// For light from `cos_o`; `reflectance` is of the cosine to the facet, what it leaves refracts by eta. With
// slopes r alpha: D(h) (w.h) dh / w.z = (w.h) / (w.z h.z) dv dphi / 2 pi with v = r^2 / (1 + r^2), and v = 1
// - (1 - t)^2, for at grazing angles the integrand grows with r. n x n midpoints.
template <typename Reflectance>
Energy microfacet_energy(double cos_o, double alpha, double eta, Reflectance reflectance, int n = 400) {
    const double sin_o = std::sqrt(1 - cos_o * cos_o);
    const auto lambda = [&](double cos_w) {
        return (std::sqrt(1 + alpha * alpha * (1 - cos_w * cos_w) / (cos_w * cos_w)) - 1) / 2;
    };
    const double lambda_o = lambda(cos_o);
    Energy sum;
    for (int i = 0; i < n; ++i) {
        const double t = (i + 0.5) / n;
        const double slope = alpha * std::sqrt(1 - (1 - t) * (1 - t)) / (1 - t);
        const double cos_facet = 1 / std::sqrt(1 + slope * slope);
        for (int j = 0; j < n; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / n;
            const double cos_h = (sin_o * slope * std::cos(phi) + cos_o) * cos_facet;
            if (cos_h <= 0) continue;
            const double weight = 2 * (1 - t) * cos_h / (cos_o * cos_facet) / (1.0 * n * n);
            const double f = reflectance(cos_h);
            const double reflected_z = 2 * cos_h * cos_facet - cos_o;
            if (reflected_z > 0) sum.reflected += weight * f / (1 + lambda_o + lambda(reflected_z));
            const double g2 = eta * eta - 1 + cos_h * cos_h;
            if (g2 <= 0) continue;
            const double refracted_z = ((cos_h - std::sqrt(g2)) * cos_facet - cos_o) / eta;
            if (refracted_z < 0) sum.transmitted += weight * (1 - f) / (1 + lambda_o + lambda(refracted_z));
        }
    }
    return sum;
}

inline Energy glass_energy(double cos_o, double alpha, double eta, int n = 400) {
    return microfacet_energy(
        cos_o, alpha, eta, [eta](double c) { return exact_fresnel(c, eta); }, n);
}

// Schlick's reflectance, for metals.
inline Energy metal_energy(double cos_o, double alpha, double f0, int n = 400) {
    return microfacet_energy(
        cos_o, alpha, 1.5, [f0](double c) { return f0 + (1 - f0) * std::pow(1 - c, 5); }, n);
}

}  // namespace tarn
