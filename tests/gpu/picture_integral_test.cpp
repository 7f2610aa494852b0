// Pictures whose answer is an integral: exact mode within three standard errors of it and within half a
// percent, by every way of sampling light.
#include "known_light.h"

namespace tarn {
namespace {

class PictureIntegralTest : public GlTest {};

constexpr int quadrature_points = 2'000'000;

// `paths`: over the whole picture, a third of them where light is sampled, which leaves less noise even so.
// `by_chance`: without light sampling, the first choice, as well.
void expect_everywhere(const KnownPlace& place, double expected, int paths, bool by_chance = true) {
    constexpr int side_px = 64;
    for (std::size_t i = by_chance ? 0 : 1; i < choice_names<LightSampling>().size(); ++i) {
        const int per_pixel = paths / (i == 0 ? 1 : 3) / (side_px * side_px);
        const Measured seen = measure(place, static_cast<LightSampling>(i), side_px, per_pixel);
        fmt::print("{:<13} expected {:.6f}, seen {:.6f}: {:+.3f} %, {:+.2f} standard errors of {:.3f} %\n",
                   choice_names<LightSampling>()[i], expected, seen.mean, 100 * (seen.mean / expected - 1),
                   (seen.mean - expected) / seen.error, 100 * seen.error / expected);
        EXPECT_NEAR(seen.mean, expected, 3 * seen.error) << choice_names<LightSampling>()[i];
        EXPECT_NEAR(seen.mean, expected, 0.005 * expected) << choice_names<LightSampling>()[i];
        // Otherwise three of them would be more than half a percent.
        EXPECT_LT(seen.error, 0.0017 * expected) << choice_names<LightSampling>()[i];
    }
}

// Part of a hemisphere's cosine-weighted light that a rectangle sends to a point: the point's normal goes
// through a corner of a parallel one of a x b at distance c.
double parallel_corner(double a, double b, double c) {
    const double x = std::hypot(a, c);
    const double y = std::hypot(b, c);
    return (a / x * std::atan(b / x) + b / y * std::atan(a / y)) / (2 * known_pi);
}
// And of an upright one that stands on the point's plane at distance c: from straight before the point b
// sideways, h high.
double upright_corner(double b, double h, double c) {
    const double s = std::hypot(h, c);
    return (std::atan(b / c) - c / s * std::atan(b / s)) / (2 * known_pi);
}

double upright(double left, double right, double h, double c) {
    const auto signed_corner = [&](double b) { return std::copysign(upright_corner(std::abs(b), h, c), b); };
    return signed_corner(right) - signed_corner(left);
}
double parallel(double x0, double x1, double z0, double z1, double c) {
    const auto corner = [&](double a, double b) {
        return std::copysign(1.0, a) * std::copysign(1.0, b) * parallel_corner(std::abs(a), std::abs(b), c);
    };
    return corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
}

// Mean over the picture of a factor at a floor point.
template <typename Factor>
double mean_over_picture(const KnownPlace& place, const Factor& factor) {
    constexpr int n = 96;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) sum += factor(place.floor_point((i + 0.5) / n, (j + 0.5) / n));
    return sum / (n * n);
}

KnownPlace beside_a_wall() {
    return {.size = {40, 12, 24},
            .boxes = {{{0, 0, 0}, {40, 1, 24}}, {{6, 1, 10}, {30, 9, 12}}},
            .sky = 0.8,
            .eye = {20, 11, 23},
            .target = {20, 1, 14}};
}

TEST_F(PictureIntegralTest, UnderAUniformSkyBesideAWall) {
    const KnownPlace place = beside_a_wall();
    const double expected = place.integral(quadrature_points);
    // Of the wall a point in front sees one face: the sky is the rest.
    const double closed = known_albedo * place.sky * mean_over_picture(place, [](const glm::dvec3& p) {
                              return 1 - upright(6 - p.x, 30 - p.x, 8, p.z - 12);
                          });
    EXPECT_NEAR(expected, closed, 3e-4 * closed) << "the two answers must agree";
    EXPECT_LT(expected, 0.8 * known_albedo * place.sky) << "the wall must matter";
    expect_everywhere(place, expected, 500'000);
}

KnownPlace lit_box(const KnownBox& lamp) {
    KnownPlace place{.size = {12, 10, 14},
                     .boxes = {{{0, 0, 0}, {12, 1, 14}},
                               {{0, 9, 0}, {12, 10, 14}},
                               {{0, 1, 0}, {1, 9, 14}},
                               {{11, 1, 0}, {12, 9, 14}},
                               {{1, 1, 0}, {11, 9, 1}},
                               {{1, 1, 13}, {11, 9, 14}},
                               lamp},
                     .eye = {6.5f, 8, 10},
                     .target = {5, 1, 7},
                     .fov_deg = 20};
    // The picture shows floor alone.
    for (const double u : {0.0, 1.0}) {
        for (const double v : {0.0, 1.0}) {
            const glm::dvec3 p = place.floor_point(u, v);
            EXPECT_TRUE(p.x > 1 && p.x < 11 && p.z > 1 && p.z < 13) << p.x << " " << p.z;
        }
    }
    return place;
}

TEST_F(PictureIntegralTest, TheFloorOfABoxWhoseWallShines) {
    const KnownPlace place = lit_box({{0, 1, 0}, {1, 9, 14}, 3});
    const double expected = 3 * known_albedo * mean_over_picture(place, [](const glm::dvec3& p) {
                                return upright(1 - p.z, 13 - p.z, 8, p.x - 1);
                            });
    expect_everywhere(place, expected, 1'800'000);
}

TEST_F(PictureIntegralTest, TheFloorOfABoxWhoseCeilingShines) {
    const KnownPlace place = lit_box({{0, 9, 0}, {12, 10, 14}, 2});
    const double expected = 2 * known_albedo * mean_over_picture(place, [](const glm::dvec3& p) {
                                return parallel(1 - p.x, 11 - p.x, 1 - p.z, 13 - p.z, 8);
                            });
    expect_everywhere(place, expected, 1'500'000);
}

// A lamp of 3 x 2 x 3 voxels, two above the floor.
KnownPlace under_a_lamp(const glm::vec3& target) {
    return {.size = {24, 10, 24},
            .boxes = {{{0, 0, 0}, {24, 1, 24}}, {{10, 3, 10}, {13, 5, 13}, 5}},
            .eye = {11.5f, 2.5f, 23},
            .target = target};
}

TEST_F(PictureIntegralTest, UnderALampOfSixFaces) {
    for (const glm::vec3& target : {glm::vec3(11.5f, 1, 11.5f), {14.5f, 1, 12}, {9.5f, 1, 13.7f}}) {
        const KnownPlace place = under_a_lamp(target);
        const double expected = place.integral(quadrature_points);
        // The faces that a point of the floor can see: the underside, and a side where it lies beyond it.
        // What shows of an upright face is its whole down to the floor less what is cut off.
        const double closed =
            5 * known_albedo * mean_over_picture(place, [](const glm::dvec3& p) {
                double factor = parallel(10 - p.x, 13 - p.x, 10 - p.z, 13 - p.z, 2);
                const auto side = [&](double left, double right, double beyond) {
                    if (beyond > 0)
                        factor += upright(left, right, 4, beyond) - upright(left, right, 2, beyond);
                };
                side(10 - p.z, 13 - p.z, p.x - 13);
                side(10 - p.z, 13 - p.z, 10 - p.x);
                side(10 - p.x, 13 - p.x, p.z - 13);
                side(10 - p.x, 13 - p.x, 10 - p.z);
                return factor;
            });
        EXPECT_NEAR(expected, closed, 1e-3 * closed) << "the two answers must agree";
        expect_everywhere(place, closed, 3'600'000);
    }
}

TEST_F(PictureIntegralTest, UnderALampHalfHiddenByAnObstacle) {
    KnownPlace place = under_a_lamp({14.5f, 1, 12});
    place.eye = {21, 2.5f, 20};  // past the obstacle
    const double open = place.integral(quadrature_points);
    place.boxes.push_back({{13, 1, 12}, {14, 3, 14}});
    const double expected = place.integral(quadrature_points);
    EXPECT_LT(expected, 0.8 * open) << "the obstacle must matter";
    EXPECT_GT(expected, 0.2 * open);
    expect_everywhere(place, expected, 5'000'000);
}

KnownPlace in_the_penumbra(float radius_deg, float target_z) {
    KnownPlace place = beside_a_wall();
    place.sky = 0;
    place.sun_irradiance = 3;
    place.sun_azimuth_deg = 20;
    place.sun_elevation_deg = 50;
    place.sun_radius_deg = radius_deg;
    place.target.z = target_z;
    return place;
}

TEST_F(PictureIntegralTest, InThePenumbraOfAWallUnderALargeSun) {
    const KnownPlace place = in_the_penumbra(30, 17);
    KnownPlace open = place;
    open.boxes.pop_back();
    const double expected = place.integral(quadrature_points);
    const double unshaded = open.integral(quadrature_points);
    // A disc wholly above the horizon gives a level surface its irradiance times the sine of its centre's
    // height.
    const double closed = known_albedo / known_pi * 3 * std::sin(50 * known_pi / 180);
    EXPECT_NEAR(unshaded, closed, 1e-4 * closed) << "the two answers must agree";
    EXPECT_LT(expected, 0.8 * unshaded);
    EXPECT_GT(expected, 0.2 * unshaded);
    expect_everywhere(place, expected, 6'000'000);
}

TEST_F(PictureIntegralTest, InThePenumbraOfAWallUnderASmallSun) {
    // The edge at (y 9, z 12) seen from z: its slope in the plane across the wall is tan 50 / cos 20.
    const double edge_z = 12 + 8 * std::cos(20 * known_pi / 180) / std::tan(50 * known_pi / 180);
    const KnownPlace place = in_the_penumbra(1, static_cast<float>(edge_z));
    const double expected = place.integral(quadrature_points);
    const double unshaded = known_albedo / known_pi * 3 * std::sin(50 * known_pi / 180);
    EXPECT_LT(expected, 0.7 * unshaded);
    EXPECT_GT(expected, 0.3 * unshaded);
    // Chance finds a disc of 1 degree once in 4000 directions.
    expect_everywhere(place, expected, 500'000, false);
}

// Where a low sun reaches, and in the wall's shadow.
TEST_F(PictureIntegralTest, UnderAClearSkyBesideAWall) {
    for (const float elevation_deg : {12.f, 50.f}) {
        KnownPlace place = beside_a_wall();
        place.turbidity = 2.5;
        place.sun_azimuth_deg = elevation_deg < 20 ? 100 : 20;
        place.sun_elevation_deg = elevation_deg;
        place.sun_radius_deg = 1;
        expect_everywhere(place, place.integral(quadrature_points / 4), 800'000, false);
    }
}

}  // namespace
}  // namespace tarn
