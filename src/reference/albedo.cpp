#include "reference/albedo.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "shared/trace.h"

namespace tarn {

namespace {

double fresnel(double cos_i, double eta) {
    if (eta == 1) return 0;
    const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1) return 1;
    const double cos_t = std::sqrt(1 - sin2_t);
    const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

double lambda(const glm::dvec3& w, double alpha) {
    const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);
}

// Mean of `scattered`(wo, h, cosine between them, masking by a direction) over the facets h that wo sees.
template <typename Scattered>
double ggx_mean(double cos_o, double alpha, int n, Scattered scattered) {
    const glm::dvec3 wo(std::sqrt(1 - cos_o * cos_o), 0, cos_o);
    // Normals visible from wo by the projected-disc parametrisation (Heitz 2018): independent of the shaders'
    // caps.
    const glm::dvec3 v = glm::normalize(glm::dvec3(alpha * wo.x, 0, wo.z));
    const glm::dvec3 t1(0, 1, 0);
    const glm::dvec3 t2 = glm::cross(v, t1);
    const double lambda_o = lambda(wo, alpha);
    const auto masking = [&](const glm::dvec3& wi) {
        return (1 + lambda_o) / (1 + lambda_o + lambda(wi, alpha));
    };
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double r = std::sqrt((i + 0.5) / n);
            const double phi = 2 * std::numbers::pi * (j + 0.5) / n;
            const double x = r * std::cos(phi);
            const double s = 0.5 * (1 + v.z);
            const double y = (1 - s) * std::sqrt(1 - x * x) + s * r * std::sin(phi);
            const glm::dvec3 h_std = x * t1 + y * t2 + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * v;
            const glm::dvec3 h =
                glm::normalize(glm::dvec3(alpha * h_std.x, alpha * h_std.y, std::max(1e-12, h_std.z)));
            const double cos_h = std::min(1.0, glm::dot(wo, h));
            if (cos_h > 0) sum += scattered(wo, h, cos_h, masking);
        }
    }
    return sum / (n * n);
}

// The same for what is reflected with `reflectance` of the cosine to the facet.
template <typename Reflectance>
double ggx_albedo(double cos_o, double alpha, int n, Reflectance reflectance) {
    return ggx_mean(cos_o, alpha, n,
                    [&](const glm::dvec3& wo, const glm::dvec3& h, double cos_h, const auto& masking) {
                        const glm::dvec3 wi = 2 * cos_h * h - wo;
                        return wi.z > 0 ? reflectance(cos_h) * masking(wi) : 0.0;
                    });
}

// Below ALPHA_SMOOTH nothing is looked up that depends on the angle.
double least_roughness() {
    return std::sqrt(static_cast<double>(ALPHA_SMOOTH));
}

// Both directions of the axis that the tables share.
double root_of_angle(double angle, double roughness) {
    return roughness * angle / (1 + roughness - angle);
}
double angle_of_root(double root, double roughness) {
    return root * (1 + roughness) / (root + roughness);
}

double facet_fresnel(double cos_o, double alpha, double eta) {
    const double a2 = alpha * alpha;
    const double c2 = cos_o * cos_o;
    const double spread = static_cast<double>(ALBEDO_FACET_SPREAD);
    return fresnel(std::min(1.0, std::sqrt((c2 + spread * a2 * (1 - c2)) / (1 + a2))), eta);
}

// The index ratio at a sample of the tables' axis.
double eta_at(int sample, int count) {
    const double x = 2.0 * sample / (count - 1) - 1;
    const double s = x * std::abs(x * x * x) * static_cast<double>(ALBEDO_ETA_RANGE);
    return (1 + s) / (1 - s);
}

}  // namespace

double ggx_dielectric_albedo(double cos_o, double alpha, double eta, int n) {
    cos_o = std::clamp(cos_o, 1e-8, 1.0);
    if (alpha < 1e-3) return fresnel(cos_o, eta);
    return ggx_albedo(cos_o, alpha, n, [eta](double cos_h) { return fresnel(cos_h, eta); });
}

double ggx_metal_albedo(double cos_o, double alpha, int n) {
    return ggx_albedo(std::clamp(cos_o, 1e-8, 1.0), alpha, n, [](double) { return 1.0; });
}

double ggx_glass_albedo(double cos_o, double alpha, double eta, int n) {
    if (eta == 1) eta = 1 + 1e-9;
    return ggx_mean(std::clamp(cos_o, 1e-8, 1.0), alpha, n,
                    [&](const glm::dvec3& wo, const glm::dvec3& h, double cos_h, const auto& masking) {
                        const double f = fresnel(cos_h, eta);
                        const glm::dvec3 reflected = 2 * cos_h * h - wo;
                        const double part = reflected.z > 0 ? f * masking(reflected) : 0;
                        if (f == 1) return part;
                        const double cos_t = std::sqrt(1 - (1 - cos_h * cos_h) / (eta * eta));
                        const glm::dvec3 refracted = (cos_h / eta - cos_t) * h - wo / eta;
                        return part + (refracted.z < 0 ? (1 - f) * masking(refracted) : 0);
                    });
}

std::vector<float> make_albedo_table() {
    constexpr int quadrature = 24;
    std::vector<float> table;
    table.reserve(std::size_t{2} * albedo_cos_count * albedo_roughness_count * albedo_eta_count);
    for (int e = 0; e < albedo_eta_count; ++e) {
        const double eta = eta_at(e, albedo_eta_count);
        const bool denser = eta >= 1;
        for (int r = 0; r < albedo_roughness_count; ++r) {
            const double row = static_cast<double>(r) / (albedo_roughness_count - 1);
            const double roughness = denser ? std::max(least_roughness(), row) : row;
            const double alpha = roughness * roughness;
            double albedo[albedo_cos_count];
            for (int c = 0; c < albedo_cos_count; ++c) {
                const double angle = static_cast<double>(c) / (albedo_cos_count - 1);
                const double root = denser ? root_of_angle(angle, roughness) : angle;
                albedo[c] = ggx_dielectric_albedo(root * root, alpha, eta, quadrature) -
                            (denser ? facet_fresnel(root * root, alpha, eta) : 0);
            }
            // 2 integral of E(mu) mu dmu with mu = u^2: 4 integral of E(u) u^3 du, E as it will be looked up.
            double mean = 0;
            constexpr int pieces = 512;
            for (int k = 0; k < pieces; ++k) {
                const double u = (k + 0.5) / pieces;
                const double at = (denser ? angle_of_root(u, roughness) : u) * (albedo_cos_count - 1);
                const int c = std::min(static_cast<int>(at), albedo_cos_count - 2);
                double value = albedo[c] + (at - c) * (albedo[c + 1] - albedo[c]);
                if (denser) value += facet_fresnel(u * u, alpha, eta);
                mean += 4 * value * u * u * u / pieces;
            }
            for (const double value : albedo) {
                table.push_back(static_cast<float>(value));
                table.push_back(static_cast<float>(mean));
            }
        }
    }
    return table;
}

std::vector<float> make_metal_albedo_table() {
    constexpr int quadrature = 100;
    std::vector<float> table;
    table.reserve(std::size_t{1} * metal_albedo_angle_count * metal_albedo_roughness_count);
    for (int r = 0; r < metal_albedo_roughness_count; ++r) {
        const double roughness =
            std::max(least_roughness(), static_cast<double>(r) / (metal_albedo_roughness_count - 1));
        for (int a = 0; a < metal_albedo_angle_count; ++a) {
            const double root =
                root_of_angle(static_cast<double>(a) / (metal_albedo_angle_count - 1), roughness);
            table.push_back(
                static_cast<float>(ggx_metal_albedo(root * root, roughness * roughness, quadrature)));
        }
    }
    return table;
}

std::vector<float> make_glass_albedo_table() {
    constexpr int quadrature = 32;
    std::vector<float> table;
    table.reserve(std::size_t{1} * glass_albedo_angle_count * glass_albedo_roughness_count *
                  glass_albedo_eta_count);
    for (int e = 0; e < glass_albedo_eta_count; ++e) {
        for (int r = 0; r < glass_albedo_roughness_count; ++r) {
            const double roughness =
                std::max(least_roughness(), static_cast<double>(r) / (glass_albedo_roughness_count - 1));
            for (int a = 0; a < glass_albedo_angle_count; ++a) {
                const double root =
                    root_of_angle(static_cast<double>(a) / (glass_albedo_angle_count - 1), roughness);
                table.push_back(static_cast<float>(ggx_glass_albedo(
                    root * root, roughness * roughness, eta_at(e, glass_albedo_eta_count), quadrature)));
            }
        }
    }
    return table;
}

}  // namespace tarn
