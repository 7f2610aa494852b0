#include "app/camera.h"

#include <algorithm>
#include <cmath>

namespace tarn {

namespace {

constexpr double longest_move_s = 0.25;
constexpr float fast_factor = 4;
// Segments are cut at this distance before the eye; small against a voxel, far above rounding.
constexpr float near_vox = 1e-3f;

constexpr float off_solids_vox = 0.25f;

float direction(bool positive, bool negative) {
    return (positive ? 1.f : 0.f) - (negative ? 1.f : 0.f);
}

// The axis of the face by which a ray enters a cell that its start is outside of.
int entry_axis(glm::ivec3 cell, glm::vec3 from_vox, glm::vec3 dir) {
    int axis = 0;
    float latest = -1;
    for (int i = 0; i < 3; ++i) {
        const float face = static_cast<float>(dir[i] > 0 ? cell[i] : cell[i] + 1);
        const float t = dir[i] == 0 ? -1 : (face - from_vox[i]) / dir[i];
        if (t > latest) {
            latest = t;
            axis = i;
        }
    }
    return axis;
}

}  // namespace

CameraBasis camera_basis(float yaw_deg, float pitch_deg) {
    const double yaw = glm::radians(static_cast<double>(yaw_deg));
    const double pitch = glm::radians(static_cast<double>(pitch_deg));
    const glm::dvec3 dir(std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
    const glm::dvec3 right(std::cos(yaw), 0, std::sin(yaw));
    return {glm::vec3(dir), glm::vec3(right), glm::vec3(glm::cross(right, dir))};
}

View::View(const Settings& settings, glm::ivec2 size_px)
    : eye_(settings.camera_position_vox),
      basis_(camera_basis(settings.camera_yaw_deg, settings.camera_pitch_deg)),
      size_px_(glm::max(size_px, 1)) {
    const double half_height = std::tan(glm::radians(static_cast<double>(settings.camera_fov_deg)) / 2);
    half_extent_ = glm::dvec2(half_height * size_px_.x / size_px_.y, half_height);
}

glm::vec3 View::dir_through(glm::vec2 at_px) const {
    const glm::vec2 uv = (2.f * at_px / size_px_ - 1.f) * glm::vec2(1, -1) * half_extent_;
    return glm::normalize(basis_.dir + uv.x * basis_.right + uv.y * basis_.up);
}

std::optional<std::array<glm::vec2, 2>> View::project(glm::vec3 from_vox, glm::vec3 to_vox) const {
    // x to the right, y up, z ahead
    const auto view_from_world = [&](glm::vec3 point) {
        const glm::vec3 offset = point - eye_;
        return glm::vec3(glm::dot(offset, basis_.right), glm::dot(offset, basis_.up),
                         glm::dot(offset, basis_.dir));
    };
    glm::vec3 from = view_from_world(from_vox);
    glm::vec3 to = view_from_world(to_vox);
    if (from.z < near_vox && to.z < near_vox) return std::nullopt;
    if (from.z < near_vox) from = glm::mix(from, to, (near_vox - from.z) / (to.z - from.z));
    if (to.z < near_vox) to = glm::mix(to, from, (near_vox - to.z) / (from.z - to.z));
    const auto px_from_view = [&](glm::vec3 point) {
        const glm::vec2 ndc = glm::vec2(point) / (std::max(point.z, near_vox) * half_extent_);
        return (ndc * glm::vec2(1, -1) + 1.f) / 2.f * size_px_;
    };
    return std::array{px_from_view(from), px_from_view(to)};
}

void fly(Settings& settings, const Input& input, bool turn) {
    const SettingInfo& position_info = *find_setting("camera_position_vox");
    if (turn && input.mouse_delta_px != glm::vec2(0)) {
        const glm::vec2 turn_deg = input.mouse_delta_px * settings.mouse_sensitivity;
        settings.camera_yaw_deg = std::remainder(settings.camera_yaw_deg + turn_deg.x, 360.f);
        settings.camera_pitch_deg = std::clamp(settings.camera_pitch_deg - turn_deg.y, -90.f, 90.f);
    }
    const CameraBasis basis = camera_basis(settings.camera_yaw_deg, settings.camera_pitch_deg);
    glm::vec3 heading = direction(input.is_down(Key::Forward), input.is_down(Key::Back)) * basis.dir +
                        direction(input.is_down(Key::Right), input.is_down(Key::Left)) * basis.right +
                        direction(input.is_down(Key::Up), input.is_down(Key::Down)) * glm::vec3(0, 1, 0);
    if (glm::length(heading) < 1e-3f) return;
    heading = glm::normalize(heading);
    const double dt_s = std::clamp(input.dt_s, 0.0, longest_move_s);
    const float speed_vox_s = settings.fly_speed_vox_s * (input.is_down(Key::Fast) ? fast_factor : 1.f);
    settings.camera_position_vox = glm::clamp(
        settings.camera_position_vox + heading * speed_vox_s * static_cast<float>(dt_s),
        glm::vec3(static_cast<float>(position_info.min)), glm::vec3(static_cast<float>(position_info.max)));
}

glm::vec3 slide(glm::vec3 from_vox, glm::vec3 to_vox, const MeetsSolid& meets) {
    glm::vec3 at = from_vox;
    glm::vec3 move = to_vox - from_vox;
    // Each face takes one direction away: in a corner three do.
    for (int i = 0; i < 3; ++i) {
        const float length = glm::length(move);
        if (!(length > 0)) return at;
        const auto face = meets(at, move / length);
        if (!face) return at + move;
        if (*face == glm::ivec3(glm::floor(at))) return to_vox;
        const int axis = entry_axis(*face, at, move);
        const int plane = (*face)[axis] + (move[axis] > 0 ? 0 : 1);
        const float room = std::abs(static_cast<float>(plane) - at[axis]) - off_solids_vox;
        const float share = std::max(room, 0.f) / std::max(std::abs(move[axis]), 1e-20f);
        if (share >= 1) return at + move;
        at += share * move;
        move *= 1 - share;
        move[axis] = 0;
    }
    return at;
}

}  // namespace tarn
