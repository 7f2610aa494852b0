// Places made of boxes whose direct light on a floor is an integral known on the CPU in double precision: the
// same boxes as a scene, and as what a ray meets.
#pragma once
#include <limits>
#include <numbers>
#include <vector>

#include "picture.h"
#include "reference/clear_sky.h"

namespace tarn {

constexpr double known_pi = std::numbers::pi;
constexpr double known_albedo = 0.5;

struct KnownBox {
    glm::ivec3 min, max;
    double emission = 0;
};

// The floor's top is the plane y = 1. The eye sees a square of it around `target`.
struct KnownPlace {
    glm::ivec3 size;
    std::vector<KnownBox> boxes;
    double sky = 0;  // radiance, all round
    double sun_irradiance = 0;
    double turbidity = 0;  // of a clear sky and its sun, whose red light counts; 0: sky and sun_irradiance
    float sun_azimuth_deg = 0, sun_elevation_deg = 45, sun_radius_deg = 0;
    glm::vec3 eye;
    glm::vec3 target;
    float fov_deg = 2;

    Scene scene(std::uint32_t seed) const {
        Scene scene = scene_from(fmt::format(R"({{"size": [{}, {}, {}], "materials": {{"wall": {{"ior": 1,
            "base_color": [{}, 1, 1]}}}}}})",
                                             size.x, size.y, size.z, known_albedo));
        scene.seed = seed;
        for (const KnownBox& box : boxes) {
            const bool shines = box.emission > 0;
            if (shines) {
                Material& lamp = scene.materials[MATERIAL_LAMP];
                lamp.base_color = glm::vec3(0);
                lamp.ior = 1;
                lamp.emission = glm::vec3(static_cast<float>(box.emission));
            }
            for (int z = box.min.z; z < box.max.z; ++z)
                for (int y = box.min.y; y < box.max.y; ++y)
                    for (int x = box.min.x; x < box.max.x; ++x)
                        scene.cells.at({x, y, z}) = shines ? MATERIAL_LAMP : MATERIAL_WALL;
        }
        Settings& s = scene.settings;
        const glm::vec3 d = glm::normalize(target - eye);
        s.camera_position_vox = eye;
        s.camera_yaw_deg = glm::degrees(std::atan2(d.x, -d.z));
        s.camera_pitch_deg = glm::degrees(std::asin(d.y));
        s.camera_fov_deg = fov_deg;
        s.sky_zenith = s.sky_horizon = glm::vec3(static_cast<float>(sky));
        s.sun_irradiance = glm::vec3(static_cast<float>(sun_irradiance));
        s.sun_azimuth_deg = sun_azimuth_deg;
        s.sun_elevation_deg = sun_elevation_deg;
        s.sun_angular_radius_deg = sun_radius_deg;
        if (turbidity > 0) {
            s.sky_model = SkyModel::Preetham;
            s.turbidity = static_cast<float>(turbidity);
        }
        return scene;
    }

    // Where the floor lies under the square picture's (u, v) in [0,1]^2.
    glm::dvec3 floor_point(double u, double v) const {
        const glm::dvec3 d = glm::normalize(glm::dvec3(target) - glm::dvec3(eye));
        const glm::dvec3 right = glm::normalize(glm::cross(d, glm::dvec3(0, 1, 0)));
        const double half = std::tan(fov_deg * known_pi / 360);
        const glm::dvec3 ray = d + right * (half * (2 * u - 1)) + glm::cross(right, d) * (half * (2 * v - 1));
        return glm::dvec3(eye) + ray * ((1 - eye.y) / ray.y);
    }

    // Emission of the first box that the ray meets; none: negative.
    double met(const glm::dvec3& from, const glm::dvec3& dir) const {
        double nearest = std::numeric_limits<double>::infinity();
        double emission = -1;
        for (const KnownBox& box : boxes) {
            double enter = 0;
            double leave = nearest;
            for (int k = 0; k < 3; ++k) {
                if (dir[k] == 0) {
                    if (from[k] <= box.min[k] || from[k] >= box.max[k]) leave = -1;
                    continue;
                }
                const double a = (box.min[k] - from[k]) / dir[k];
                const double b = (box.max[k] - from[k]) / dir[k];
                enter = std::max(enter, std::min(a, b));
                leave = std::min(leave, std::max(a, b));
            }
            if (enter < leave && leave > 1e-9) {
                nearest = enter;
                emission = box.emission;
            }
        }
        return emission;
    }

    // Mean radiance of the picture after one scattering: `count` points over picture and directions at once,
    // of the sequence whose steps are powers of the root of x^5 = x + 1 (Roberts 2018).
    double integral(int count) const {
        constexpr double root = 1.1673039782614187;
        const auto point = [](int i, double power) {
            double whole = 0;
            return std::modf(0.5 + i / power, &whole);
        };
        const double azimuth = glm::radians(static_cast<double>(sun_azimuth_deg));
        const double elevation = glm::radians(static_cast<double>(sun_elevation_deg));
        const double radius = glm::radians(static_cast<double>(sun_radius_deg));
        const glm::dvec3 to_sun(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                                -std::cos(azimuth) * std::cos(elevation));
        const ClearSky clear{.turbidity = turbidity,
                             .sun_azimuth_deg = sun_azimuth_deg,
                             .sun_elevation_deg = sun_elevation_deg,
                             .sun_radius_deg = sun_radius_deg};
        const double irradiance = turbidity > 0 ? clear_sun_irradiance(clear).x : sun_irradiance;
        const glm::dvec3 across = glm::normalize(glm::cross(to_sun, glm::dvec3(0, 1, 0)));
        const glm::dvec3 upward = glm::cross(across, to_sun);
        const double cap_sr = 2 * known_pi * (1 - std::cos(radius));
        // A surface that faces the disc gets L pi sin^2 of it.
        const double sun_radiance =
            radius > 0 ? irradiance / (known_pi * std::sin(radius) * std::sin(radius)) : 0;
        double light = 0;
        for (int i = 1; i <= count; ++i) {
            const glm::dvec3 p = floor_point(point(i, root), point(i, root * root));
            const double a = point(i, root * root * root);
            const double phi = 2 * known_pi * point(i, root * root * root * root);
            const glm::dvec3 dir(std::sqrt(a) * std::cos(phi), std::sqrt(1 - a),
                                 std::sqrt(a) * std::sin(phi));
            const double emission = met(p, dir);
            const double beyond = turbidity > 0 ? clear_sky_radiance(clear, dir).x : sky;
            light += known_pi * (emission < 0 ? beyond : emission);
            if (sun_radiance > 0) {
                const double z = 1 - a * (1 - std::cos(radius));
                const double r = std::sqrt(1 - z * z);
                const glm::dvec3 at =
                    to_sun * z + across * (r * std::cos(phi)) + upward * (r * std::sin(phi));
                if (at.y > 0 && met(p, at) < 0) light += sun_radiance * cap_sr * at.y;
            }
        }
        return known_albedo / known_pi * light / count;
    }
};

// What exact mode makes of it, and that mean's standard error: from two pictures of different seeds, so that
// what differs from pixel to pixel is not taken for noise.
struct Measured {
    double mean = 0, error = 0;
};
inline Measured measure(const KnownPlace& place, LightSampling sampling, int side_px, int paths_per_pixel) {
    Picture halves[2];
    for (std::uint32_t i = 0; i < 2; ++i) {
        constexpr int per_frame = 64;
        halves[i] = picture_of(place.scene(i + 1), std::max(1, paths_per_pixel / (2 * per_frame)),
                               {side_px, side_px}, [&](Settings& s) {
                                   s.max_bounces = 1;
                                   s.light_sampling = sampling;
                                   s.samples_per_pixel = per_frame;
                               });
        EXPECT_EQ(halves[i].rejected, 0u);
    }
    double squares = 0;
    for (int y = 0; y < side_px; ++y)
        for (int x = 0; x < side_px; ++x) squares += std::pow(halves[0].at(x, y).x - halves[1].at(x, y).x, 2);
    return {(halves[0].mean().x + halves[1].mean().x) / 2, std::sqrt(squares) / (2.0 * side_px * side_px)};
}

}  // namespace tarn
