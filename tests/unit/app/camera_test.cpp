#include "app/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tarn {
namespace {

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance = 1e-6f) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

Settings camera_at(glm::vec3 position, float yaw_deg, float pitch_deg, float fov_deg) {
    Settings settings;
    settings.camera_position_vox = position;
    settings.camera_yaw_deg = yaw_deg;
    settings.camera_pitch_deg = pitch_deg;
    settings.camera_fov_deg = fov_deg;
    return settings;
}

Input holding(Key key, double dt_s) {
    Input input;
    input.dt_s = dt_s;
    input.down[static_cast<std::size_t>(key)] = true;
    return input;
}

TEST(Camera, YawZeroLooksAlongMinusZAndGrowsTowardsPlusX) {
    expect_near(camera_basis(0, 0).dir, {0, 0, -1});
    expect_near(camera_basis(0, 0).right, {1, 0, 0});
    expect_near(camera_basis(0, 0).up, {0, 1, 0});
    expect_near(camera_basis(90, 0).dir, {1, 0, 0});
    expect_near(camera_basis(180, 0).dir, {0, 0, 1});
    expect_near(camera_basis(-90, 0).dir, {-1, 0, 0});
}

TEST(Camera, PitchGrowsUpward) {
    expect_near(camera_basis(0, 90).dir, {0, 1, 0});
    expect_near(camera_basis(123, -90).dir, {0, -1, 0});
    expect_near(camera_basis(0, 45).dir, {0, std::sqrt(0.5f), -std::sqrt(0.5f)});
}

TEST(Camera, BasisIsOrthonormalAndRightHanded) {
    for (int yaw = -360; yaw <= 360; yaw += 37) {
        for (int pitch = -90; pitch <= 90; pitch += 15) {
            const CameraBasis b = camera_basis(static_cast<float>(yaw), static_cast<float>(pitch));
            EXPECT_NEAR(glm::length(b.dir), 1, 1e-6);
            EXPECT_NEAR(glm::dot(b.dir, b.right), 0, 1e-6);
            EXPECT_NEAR(glm::dot(b.dir, b.up), 0, 1e-6);
            EXPECT_NEAR(b.right.y, 0, 0);
            expect_near(glm::cross(b.right, b.up), -b.dir);
        }
    }
}

TEST(Camera, RaysThroughThePictureSpanTheVerticalFieldOfView) {
    const View view(camera_at({}, 0, 0, 90), {200, 100});
    expect_near(view.dir_through({100, 50}), {0, 0, -1});
    expect_near(view.dir_through({100, 0}), glm::normalize(glm::vec3(0, 1, -1)));
    expect_near(view.dir_through({100, 100}), glm::normalize(glm::vec3(0, -1, -1)));
    expect_near(view.dir_through({200, 50}), glm::normalize(glm::vec3(2, 0, -1)));
}

TEST(Camera, ProjectionUndoesTheRay) {
    for (const float fov : {1.f, 60.f, 179.f}) {
        const View view(camera_at({3, -4, 5}, 33, -21, fov), {320, 240});
        for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(160, 120), glm::vec2(319, 7)}) {
            const glm::vec3 point = view.eye_vox() + 50.f * view.dir_through(at);
            const auto line = view.project(point, point);
            ASSERT_TRUE(line);
            EXPECT_LT(glm::distance((*line)[0], at), 0.1f) << fov;
        }
    }
}

TEST(Camera, ProjectionCutsSegmentsAtTheEye) {
    const View view(camera_at({}, 0, 0, 60), {100, 100});
    EXPECT_FALSE(view.project({0, 0, 1}, {5, 0, 9}));
    const auto line = view.project({0, 0, -10}, {1, 0, 10});
    ASSERT_TRUE(line);
    EXPECT_NEAR((*line)[0].x, 50, 1e-3);
    EXPECT_GT((*line)[1].x, 100) << "the end behind the eye leaves the picture on its own side";
    EXPECT_TRUE(std::isfinite((*line)[1].x) && std::isfinite((*line)[1].y));
}

TEST(Camera, FlyingFollowsTheView) {
    Settings settings = camera_at({0, 0, 0}, 90, 0, 60);
    settings.fly_speed_vox_s = 10;
    fly(settings, holding(Key::Forward, 0.1), false);
    expect_near(settings.camera_position_vox, {1, 0, 0});
    fly(settings, holding(Key::Right, 0.1), false);
    expect_near(settings.camera_position_vox, {1, 0, 1});
    fly(settings, holding(Key::Up, 0.1), false);
    expect_near(settings.camera_position_vox, {1, 1, 1});
    Input fast = holding(Key::Down, 0.1);
    fast.down[static_cast<std::size_t>(Key::Fast)] = true;
    fly(settings, fast, false);
    expect_near(settings.camera_position_vox, {1, -3, 1});
}

TEST(Camera, MouseTurnsRightAndUp) {
    Settings settings = camera_at({}, 0, 0, 60);
    settings.mouse_sensitivity = 0.5f;
    Input input;
    input.mouse_delta_px = {20, -10};
    fly(settings, input, false);
    EXPECT_EQ(settings.camera_yaw_deg, 0);
    fly(settings, input, true);
    EXPECT_FLOAT_EQ(settings.camera_yaw_deg, 10);
    EXPECT_FLOAT_EQ(settings.camera_pitch_deg, 5);
    input.mouse_delta_px = {1000, -1e6f};
    for (int i = 0; i < 100; ++i) fly(settings, input, true);
    EXPECT_LE(std::abs(settings.camera_yaw_deg), 180);
    EXPECT_EQ(settings.camera_pitch_deg, 90);
}

// The half-space below y = 0 and that beyond x = 10, in voxels, and one block apart.
bool is_solid(glm::ivec3 cell) {
    return cell.y < 0 || cell.x >= 10 || cell == glm::ivec3(4, 2, 4);
}

// By small steps: enough for a test.
std::optional<glm::ivec3> first_solid(glm::vec3 from, glm::vec3 dir) {
    for (float t = 0; t < 40; t += 1e-3f) {
        const glm::ivec3 cell(glm::floor(from + t * dir));
        if (is_solid(cell)) return cell;
    }
    return std::nullopt;
}

TEST(Camera, SlidesAlongSolidsAndNeverInto) {
    expect_near(slide({1, 1, 1}, {3, 2, 1}, first_solid), {3, 2, 1});
    const glm::vec3 on_ground = slide({1, 1, 1}, {3, -5, 1}, first_solid);
    expect_near(on_ground, {3, 0.25f, 1}, 1e-3f);
    const glm::vec3 in_corner = slide(on_ground, {30, -9, 2}, first_solid);
    expect_near(in_corner, {9.75f, 0.25f, 2}, 1e-3f);
    expect_near(slide(in_corner, {30, -9, 2}, first_solid), in_corner, 1e-3f);
    expect_near(slide(in_corner, {9, 3, 2}, first_solid), {9, 3, 2});
    // From within it goes freely.
    expect_near(slide({1, -2, 1}, {1, -3, 1}, first_solid), {1, -3, 1});
    expect_near(slide({1, -2, 1}, {1, 3, 1}, first_solid), {1, 3, 1});
    for (int i = 0; i < 400; ++i) {
        const auto part = [&](int prime) { return static_cast<float>(i * prime % 101) / 101.f; };
        const glm::vec3 from(9 * part(7), 0.3f + 6 * part(11), 8 * part(13));
        if (is_solid(glm::ivec3(glm::floor(from)))) continue;
        const glm::vec3 to = from + 20.f * (glm::vec3(part(17), part(19), part(23)) - 0.5f);
        const glm::vec3 end = slide(from, to, first_solid);
        EXPECT_FALSE(is_solid(glm::ivec3(glm::floor(end)))) << i;
        EXPECT_LE(glm::distance(end, from), glm::distance(to, from) + 1e-3f);
    }
}

TEST(Camera, AnyTimeStepIsSafe) {
    Settings settings = camera_at({1, 2, 3}, 0, 0, 60);
    settings.fly_speed_vox_s = 100;
    fly(settings, holding(Key::Forward, 0), false);
    expect_near(settings.camera_position_vox, {1, 2, 3});
    fly(settings, holding(Key::Forward, 10), false);
    expect_near(settings.camera_position_vox, {1, 2, 3 - 25}, 1e-4f);
    fly(settings, holding(Key::Forward, -1), false);
    expect_near(settings.camera_position_vox, {1, 2, 3 - 25}, 1e-4f);
    settings.camera_position_vox = glm::vec3(1e7f);
    fly(settings, holding(Key::Up, 10), false);
    EXPECT_LE(settings.camera_position_vox.y, 1e7f);
}

}  // namespace
}  // namespace tarn
