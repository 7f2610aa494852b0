#include "core/sun_clock.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace tarn {

SunPosition sun_position(double time_of_day_h) {
    const double latitude = glm::radians(50.0);
    const double declination = glm::radians(23.44);
    const double hour_angle = glm::radians(15 * (time_of_day_h - 12));
    const double up = std::sin(latitude) * std::sin(declination) +
                      std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
    const double west = std::cos(declination) * std::sin(hour_angle);
    const double south = std::sin(latitude) * std::cos(declination) * std::cos(hour_angle) -
                         std::cos(latitude) * std::sin(declination);
    return {180 + glm::degrees(std::atan2(west, south)), glm::degrees(std::asin(std::clamp(up, -1.0, 1.0)))};
}

}  // namespace tarn
