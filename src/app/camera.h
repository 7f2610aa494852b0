// The camera: where the eye of `Settings` looks, how hands move it, and where points land in the picture.
// Knows no GL.
#pragma once
#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <optional>

#include "core/settings.h"
#include "platform/platform.h"

namespace tarn {

// Unit vectors, right-handed: cross(right, up) = -dir. Yaw 0 looks along -z and grows towards +x; pitch grows
// upward.
struct CameraBasis {
    glm::vec3 dir, right, up;
};
CameraBasis camera_basis(float yaw_deg, float pitch_deg);

// A camera and the size of its picture.
class View {
  public:
    View(const Settings& settings, glm::ivec2 size_px);

    // Unit direction of the ray through a point of the picture (from the top left, in pixels).
    glm::vec3 dir_through(glm::vec2 at_px) const;
    // The part of a segment in front of the eye, in pixels; nothing where all of it lies behind.
    std::optional<std::array<glm::vec2, 2>> project(glm::vec3 from_vox, glm::vec3 to_vox) const;
    glm::vec3 eye_vox() const { return eye_; }

  private:
    glm::vec3 eye_;
    CameraBasis basis_;
    glm::vec2 half_extent_;  // of the picture at distance 1
    glm::vec2 size_px_;
};

// Moves and turns the camera in `settings` by one frame of input; `turn`: the mouse turns it. Any dt is safe:
// a frame moves no further than a quarter of a second does.
void fly(Settings& settings, const Input& input, bool turn);

// The first solid cell that the ray from a point along a unit direction meets, be it that of the point.
using MeetsSolid = std::function<std::optional<glm::ivec3>(glm::vec3 from_vox, glm::vec3 dir)>;

// Where an eye ends that wants to go from one point to another but may not pass solids: it slides along them,
// a quarter of a voxel off. From within a solid it goes freely.
glm::vec3 slide(glm::vec3 from_vox, glm::vec3 to_vox, const MeetsSolid& meets);

}  // namespace tarn
