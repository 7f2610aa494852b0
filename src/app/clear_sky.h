// The clear sky of Preetham, Shirley & Smits 1999 and the light of its sun, as numbers that the shaders
// evaluate.
#pragma once
#include <glm/glm.hpp>

#include "core/settings.h"
#include "shared/frame.h"

namespace tarn {

// Sunlight on a surface that faces the sun, linear sRGB. A black body of 5778 K, seen through air, haze and
// ozone; oxygen's and water vapour's narrow bands (red and beyond) are left out. Goes to 0 as the disc sets.
glm::dvec3 clear_sky_sunlight(const Settings& settings);

// Fills the sky_* fields that the sky model preetham reads. A sun below the horizon leaves the sky that it
// has on the horizon, dimmed.
void set_clear_sky(FrameBlock& block, const Settings& settings);

}  // namespace tarn
