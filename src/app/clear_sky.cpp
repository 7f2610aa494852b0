#include "app/clear_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/camera.h"
#include "core/sky_tables.h"

namespace tarn {

namespace {

constexpr double pi = std::numbers::pi;

double from_zenith_rad(const Settings& s) {
    return glm::radians(90.0 - std::clamp(static_cast<double>(s.sun_elevation_deg), 0.0, 90.0));
}

// Part of the disc above the horizon.
double risen_part(double elevation_deg, double radius_deg) {
    if (elevation_deg >= radius_deg) return elevation_deg > 0 ? 1 : 0;
    if (elevation_deg <= -radius_deg) return 0;
    const double h = elevation_deg / radius_deg;
    return (std::acos(-h) + h * std::sqrt(1 - h * h)) / pi;
}

double lobe(double nm, double peak_nm, double below, double above) {
    const double t = (nm - peak_nm) * (nm < peak_nm ? below : above);
    return std::exp(-t * t / 2);
}

// CIE 1931 matching functions (Wyman, Sloan & Shirley 2013).
glm::dvec3 matching(double nm) {
    return {1.056 * lobe(nm, 599.8, 0.0264, 0.0323) + 0.362 * lobe(nm, 442.0, 0.0624, 0.0374) -
                0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
            0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
            1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

// Above the air, W/m^2 per nm: Planck's law over the sun's 6.794e-5 sr.
double sun_spectrum(double nm) {
    constexpr double c1 = 1.191043e-16;  // 2 h c^2, W m^2
    constexpr double c2 = 1.438777e-2;   // h c / k, m K
    const double m = nm * 1e-9;
    return 6.794e-5 * 1e-9 * c1 / (std::pow(m, 5) * std::expm1(c2 / (m * 5778)));
}

glm::dvec3 linear_srgb(const glm::dvec3& xyz) {
    return glm::max(glm::dvec3(0), glm::dvec3(3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
                                              -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
                                              0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z));
}

// (Y in kcd/m^2, x, y) of the zenith; the angle is the sun's from it.
glm::dvec3 zenith_colour(double t, double angle) {
    const double chi = (4.0 / 9 - t / 120) * (pi - 2 * angle);
    glm::dvec3 colour((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192, 0, 0);
    for (int i = 0; i < 2; ++i) {
        for (const auto& row : sky_tables::zenith_chromaticity[i])
            colour[i + 1] = colour[i + 1] * t + ((row[0] * angle + row[1]) * angle + row[2]) * angle + row[3];
    }
    return colour;
}

}  // namespace

glm::dvec3 clear_sky_sunlight(const Settings& s) {
    const double part = risen_part(s.sun_elevation_deg, s.sun_angular_radius_deg);
    if (part <= 0) return glm::dvec3(0);
    const double zenith_rad = from_zenith_rad(s);
    // Masses of air passed (Kasten 1965), haze by Angstrom's law, 0.35 cm of ozone.
    const double air =
        1 / (std::cos(zenith_rad) + 0.15 * std::pow(93.885 - glm::degrees(zenith_rad), -1.253));
    const double haze = 0.04608 * s.turbidity - 0.04586;
    glm::dvec3 xyz(0);
    for (std::size_t i = 0; i < sky_tables::ozone_per_cm.size(); ++i) {
        const double nm = sky_tables::ozone_first_nm + sky_tables::ozone_step_nm * static_cast<double>(i);
        const double depth = 0.008735 * std::pow(nm / 1000, -4.08) + haze * std::pow(nm / 1000, -1.3) +
                             0.35 * sky_tables::ozone_per_cm[i];
        xyz += matching(nm) * (sun_spectrum(nm) * std::exp(-depth * air) * sky_tables::ozone_step_nm);
    }
    constexpr double lumens_per_watt = 683;
    return linear_srgb(xyz) * (part * s.sky_brightness * lumens_per_watt / 1000 / sky_tables::unit_klx);
}

void set_clear_sky(FrameBlock& block, const Settings& s) {
    const double t = s.turbidity;
    const double angle = from_zenith_rad(s);
    const glm::dvec3 zenith = zenith_colour(t, angle);
    for (int i = 0; i < 3; ++i) {
        double p[5];
        for (int k = 0; k < 5; ++k) p[k] = sky_tables::perez[i][k].slope * t + sky_tables::perez[i][k].offset;
        const double cos_angle = std::cos(angle);
        const double at_zenith =
            (1 + p[0] * std::exp(p[1])) * (1 + p[2] * std::exp(p[3] * angle) + p[4] * cos_angle * cos_angle);
        glm::vec4* const fields[] = {&block.sky_perez_a, &block.sky_perez_b, &block.sky_perez_c,
                                     &block.sky_perez_d, &block.sky_perez_e};
        for (int k = 0; k < 5; ++k) (*fields[k])[i] = static_cast<float>(p[k]);
        block.sky_perez_scale[i] = static_cast<float>(zenith[i] / at_zenith);
    }
    const double below_deg = std::max(0.0, -static_cast<double>(s.sun_elevation_deg));
    const double brightness =
        s.sky_brightness * std::pow(10.0, -sky_tables::twilight_per_deg * below_deg) / sky_tables::unit_klx;
    block.sky_perez_scale.x = static_cast<float>(block.sky_perez_scale.x * brightness);
    block.sky_sun_dir = glm::vec4(camera_basis(s.sun_azimuth_deg, std::max(0.f, s.sun_elevation_deg)).dir, 0);
    const auto& night = sky_tables::night_radiance;
    block.sky_night =
        glm::vec4(glm::dvec3(night[0], night[1], night[2]) * static_cast<double>(s.sky_brightness), 0);
}

}  // namespace tarn
