// Numbers of the clear sky and its sun, for the renderer and for the reference of its tests.
#pragma once
#include <array>

namespace tarn::sky_tables {

// Perez distribution, A to E, each slope * turbidity + offset: luminance Y, chromaticities x and y (Preetham,
// Shirley & Smits 1999, appendix A.2).
struct Linear {
    double slope, offset;
};
constexpr std::array<std::array<Linear, 5>, 3> perez = {{
    {{{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}}},
    {{{-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}}},
    {{{-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}}},
}};

// Chromaticities x and y of the zenith: [T^2, T, 1] * rows * [angle^3, angle^2, angle, 1], the sun's angle
// from the zenith in radians (the same appendix).
using Rows = std::array<std::array<double, 4>, 3>;
constexpr std::array<Rows, 2> zenith_chromaticity = {{
    {{{0.00166, -0.00375, 0.00209, 0.0},
      {-0.02903, 0.06377, -0.03202, 0.00394},
      {0.11693, -0.21196, 0.06052, 0.25886}}},
    {{{0.00275, -0.00610, 0.00317, 0.0},
      {-0.04214, 0.08970, -0.04153, 0.00516},
      {0.15346, -0.26756, 0.06670, 0.26688}}},
}};

// Absorption of ozone per centimetre at 380 to 780 nm by 10 nm (Iqbal 1983, as tabled by Preetham et al.);
// nothing below 450 nm.
constexpr double ozone_first_nm = 380;
constexpr double ozone_step_nm = 10;
constexpr std::array<double, 41> ozone_per_cm = {
    0,     0,     0,     0,     0,     0,     0,     0.003, 0.006, 0.009, 0.014, 0.021, 0.030, 0.040,
    0.048, 0.063, 0.075, 0.085, 0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067,
    0.057, 0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009, 0.007, 0.004, 0};

// What follows is this program's own choice.

// Illuminance of irradiance 1, klx; luminance of radiance 1, kcd/m^2. A summer noon is then as bright as the
// sky gradient and its sun are by default.
constexpr double unit_klx = 25;

// Powers of ten that the sky loses with each degree of the sun below the horizon: measured twilight's first
// ten degrees, about.
constexpr double twilight_per_deg = 0.38;

// Radiance of the sky that is left without the sun, linear sRGB: a night for eyes that are used to it. The
// real one, without a moon, is a million times darker.
constexpr std::array<double, 3> night_radiance = {0.010, 0.018, 0.036};

}  // namespace tarn::sky_tables
