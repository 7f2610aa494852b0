// Where the sun stands by the hour: what `time_of_day_h` writes.
#pragma once

namespace tarn {

struct SunPosition {
    double azimuth_deg;    // from -z (north) to +x (east), as a camera's yaw; 0 to 360, growing all day
    double elevation_deg;  // of the centre; refraction is left out
};

// Of the sun's own day, so that it is highest at 12: 21 June at 50 degrees north. 0 to 24 hours.
SunPosition sun_position(double time_of_day_h);

}  // namespace tarn
