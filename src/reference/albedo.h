// Directional albedo of a GGX interface by quadrature in double precision: the table that the shaders read,
// and the reference of their tests.
#pragma once
#include <vector>

namespace tarn {

// Part of light arriving from a direction at `cos_o` to the normal that a dielectric GGX interface of `alpha`
// and eta = index beyond / index here reflects after one scattering. Smooth below alpha 1e-3. `n` x `n`
// points.
double ggx_dielectric_albedo(double cos_o, double alpha, double eta, int n);

// The same of a metal that reflects all at every angle: what is missing to 1 scatters more than once.
double ggx_metal_albedo(double cos_o, double alpha, int n);

// The same of rough glass, reflected and transmitted together; eta = 1 stands for the limit.
double ggx_glass_albedo(double cos_o, double alpha, double eta, int n);

// Axes of the table of dielectrics: the angle, roughness = sqrt(alpha), x of ALBEDO_ETA_RANGE
// (glsl/shared/trace.h); all ends included. The angle is sqrt(cos) for eta < 1. For eta >= 1 it is that of
// the table of metals.
constexpr int albedo_cos_count = 32;
constexpr int albedo_roughness_count = 32;
constexpr int albedo_eta_count = 65;

// Pairs (E(cos), Eavg), angle fastest, then roughness, then eta; for eta >= 1 E is less the reflectance of
// ALBEDO_FACET_SPREAD. Eavg integrates the table's own interpolation, so that a white base under it conserves
// energy.
std::vector<float> make_albedo_table();

// Axes of the table of metals: sqrt(cos) (1 + roughness) / (sqrt(cos) + roughness), which follows the dip of
// the albedo at cos = alpha into small alpha, and roughness; both ends included. Bilinear, it is within 0.2 %
// of the integral.
constexpr int metal_albedo_angle_count = 32;
constexpr int metal_albedo_roughness_count = 32;

// Angle fastest, then roughness.
std::vector<float> make_metal_albedo_table();

// Axes of the table of rough glass: the angle and the roughness of the table of metals, x of
// ALBEDO_ETA_RANGE.
constexpr int glass_albedo_angle_count = 32;
constexpr int glass_albedo_roughness_count = 24;
constexpr int glass_albedo_eta_count = 49;

// Angle fastest, then roughness, then eta.
std::vector<float> make_glass_albedo_table();

}  // namespace tarn
