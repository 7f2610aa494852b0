// The clear sky and its sun in double precision, written apart from src/app/clear_sky.cpp and
// glsl/lib/sky.glsl: the equations of Preetham, Shirley & Smits 1999 as printed.
#pragma once
#include <glm/glm.hpp>

namespace tarn {

struct ClearSky {
    double turbidity = 2.5;
    double sun_azimuth_deg = 0, sun_elevation_deg = 45;  // as Settings has them
    double sun_radius_deg = 0.27;
    double brightness = 1;
};

// (Y, x, y): luminance in kcd/m^2 and chromaticity of the direction (unit, y up), with neither twilight nor
// night. The sun counts as no lower than the horizon.
glm::dvec3 clear_sky_yxy(const ClearSky& sky, const glm::dvec3& dir);

// Linear sRGB in the renderer's units: the whole model.
glm::dvec3 clear_sky_radiance(const ClearSky& sky, const glm::dvec3& dir);

// CIE XYZ, Y in klx, on a surface that faces the whole disc.
glm::dvec3 clear_sun_xyz(const ClearSky& sky);

// Linear sRGB in the renderer's units, of that part of the disc which has risen.
glm::dvec3 clear_sun_irradiance(const ClearSky& sky);

}  // namespace tarn
