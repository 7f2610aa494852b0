#include "reference/clear_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sky_tables.h"

namespace tarn {

namespace {

constexpr double pi = std::numbers::pi;

double sun_zenith_angle(const ClearSky& sky) {
    return pi / 2 - std::clamp(sky.sun_elevation_deg, 0.0, 90.0) * pi / 180;
}

double perez(int channel, double turbidity, double theta, double gamma) {
    const auto& table = sky_tables::perez[channel];
    const auto c = [&](int k) { return table[k].slope * turbidity + table[k].offset; };
    // Towards the horizon exp(B / cos) goes to 0 for the B < 0 of every turbidity from 2 on.
    const double from_horizon = theta < pi / 2 ? std::exp(c(1) / std::cos(theta)) : 0;
    return (1 + c(0) * from_horizon) *
           (1 + c(2) * std::exp(c(3) * gamma) + c(4) * std::pow(std::cos(gamma), 2));
}

double zenith(int channel, double turbidity, double sun) {
    if (channel == 0) {
        const double chi = (4.0 / 9.0 - turbidity / 120.0) * (pi - 2 * sun);
        return (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
    }
    double sum = 0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            sum += std::pow(turbidity, 2 - row) * std::pow(sun, 3 - column) *
                   sky_tables::zenith_chromaticity[channel - 1][row][column];
    return sum;
}

// From the chromaticities of the primaries and of D65 (IEC 61966-2-1).
glm::dmat3 xyz_to_srgb() {
    const auto column = [](double x, double y) { return glm::dvec3(x / y, 1, (1 - x - y) / y); };
    const glm::dmat3 primaries(column(0.64, 0.33), column(0.30, 0.60), column(0.15, 0.06));
    const glm::dvec3 amounts = glm::inverse(primaries) * column(0.3127, 0.3290);
    return glm::inverse(
        glm::dmat3(primaries[0] * amounts.x, primaries[1] * amounts.y, primaries[2] * amounts.z));
}

glm::dvec3 srgb_of(const glm::dvec3& xyz) {
    static const glm::dmat3 matrix = xyz_to_srgb();
    return glm::max(matrix * xyz, glm::dvec3(0));
}

double bell(double nm, double mean, double below, double above) {
    return std::exp(-0.5 * std::pow((nm - mean) * (nm < mean ? below : above), 2));
}

double ozone_per_cm(double nm) {
    const auto& table = sky_tables::ozone_per_cm;
    const double at = (nm - sky_tables::ozone_first_nm) / sky_tables::ozone_step_nm;
    const auto i = std::min(static_cast<std::size_t>(at), table.size() - 2);
    return std::lerp(table[i], table[i + 1], at - static_cast<double>(i));
}

}  // namespace

glm::dvec3 clear_sky_yxy(const ClearSky& sky, const glm::dvec3& dir) {
    const double azimuth = sky.sun_azimuth_deg * pi / 180;
    const double sun = sun_zenith_angle(sky);
    const glm::dvec3 to_sun(std::sin(azimuth) * std::sin(sun), std::cos(sun),
                            -std::cos(azimuth) * std::sin(sun));
    // Below the horizon: its own part along the horizon, which shrinks to nothing straight down.
    const glm::dvec3 d(dir.x, std::max(dir.y, 0.0), dir.z);
    const double cos_gamma = 2 * glm::dot(d, to_sun) / (glm::dot(d, d) + 1);
    const double gamma = std::acos(std::clamp(cos_gamma, -1.0, 1.0));
    const double theta = std::acos(std::min(d.y, 1.0));
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i)
        result[i] = zenith(i, sky.turbidity, sun) * perez(i, sky.turbidity, theta, gamma) /
                    perez(i, sky.turbidity, 0, sun);
    return result;
}

glm::dvec3 clear_sky_radiance(const ClearSky& sky, const glm::dvec3& dir) {
    const glm::dvec3 c = clear_sky_yxy(sky, dir);
    const double depth_deg = std::max(0.0, -sky.sun_elevation_deg);
    const double luminance =
        c.x * std::pow(10, -sky_tables::twilight_per_deg * depth_deg) / sky_tables::unit_klx;
    const glm::dvec3 xyz = glm::dvec3(c.y / c.z, 1, (1 - c.y - c.z) / c.z) * luminance;
    const auto& night = sky_tables::night_radiance;
    return (srgb_of(xyz) + glm::dvec3(night[0], night[1], night[2])) * sky.brightness;
}

glm::dvec3 clear_sun_xyz(const ClearSky& sky) {
    constexpr double h = 6.62607015e-34;
    constexpr double c = 2.99792458e8;
    constexpr double k = 1.380649e-23;
    const double theta = sun_zenith_angle(sky);
    const double m = 1 / (std::cos(theta) + 0.15 * std::pow(93.885 - theta * 180 / pi, -1.253));
    const double beta = 0.04608 * sky.turbidity - 0.04586;
    glm::dvec3 xyz(0);
    for (int nm = 380; nm <= 780; ++nm) {
        const double metres = nm * 1e-9;
        const double micrometres = nm * 1e-3;
        const double radiance =
            2 * h * c * c / std::pow(metres, 5) / (std::exp(h * c / (metres * k * 5778)) - 1);
        const double transmittance = std::exp(-0.008735 * std::pow(micrometres, -4.08) * m) *
                                     std::exp(-beta * std::pow(micrometres, -1.3) * m) *
                                     std::exp(-0.35 * ozone_per_cm(nm) * m);
        const glm::dvec3 seen(
            0.362 * bell(nm, 442, 0.0624, 0.0374) + 1.056 * bell(nm, 599.8, 0.0264, 0.0323) -
                0.065 * bell(nm, 501.1, 0.0490, 0.0382),
            0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322),
            1.217 * bell(nm, 437, 0.0845, 0.0278) + 0.681 * bell(nm, 459, 0.0385, 0.0725));
        // Sunlight fills 6.794e-5 sr; 683 lm/W; to klx.
        xyz += seen * (radiance * 1e-9 * 6.794e-5 * transmittance * 683 / 1000);
    }
    return xyz;
}

glm::dvec3 clear_sun_irradiance(const ClearSky& sky) {
    // Risen part of a flat disc: its segment above the horizon.
    const double e = sky.sun_elevation_deg;
    const double r = sky.sun_radius_deg;
    double part = e > 0 ? 1 : 0;
    if (r > 0 && std::abs(e) < r) {
        const double half = std::acos(e / r);
        part = 1 - (half - std::sin(half) * std::cos(half)) / pi;
    }
    return srgb_of(clear_sun_xyz(sky)) * (part * sky.brightness / sky_tables::unit_klx);
}

}  // namespace tarn
