// The walk of rays through the cells on the CPU: the float32 expressions of glsl/lib/traversal.glsl, voxel by
// voxel, written plainly. The GPU's walk must agree with it in every bit.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "world/cells.h"

namespace tarn::reference {

// Where a ray starts: `cell` is the voxel that it is in (one outside the world for a ray that enters);
// `medium` is the material id around the origin.
struct RayStart {
    glm::vec3 origin_vox{0};
    glm::ivec3 cell{0};
    std::uint32_t medium = MATERIAL_AIR;
};

enum class HitKind {
    None,    // left the world in air, or beyond the limit
    Face,    // the medium changes at the face between `previous` and `cell`
    Surface  // the medium changes at the water surface inside `cell`; previous == cell
};

struct RayHit {
    HitKind kind = HitKind::None;
    float t = 0;  // voxels from the origin; the limit where nothing is hit
    glm::ivec3 previous{0};
    glm::ivec3 cell{0};  // may lie one outside the world
    int axis = 0;        // of the face: 0, 1, 2; 1 for a surface
    std::uint32_t beyond = MATERIAL_AIR;
    std::uint32_t byte_beyond = 0;  // of `cell`; 0 outside
};

// Constants of glsl/lib/traversal.glsl.
constexpr float traversal_still = 1e-30f;
constexpr float traversal_never = 3e38f;
constexpr float traversal_t_max = 1e30f;

// True for water that leaves air above it in its voxel.
bool is_partly_filled(std::uint32_t byte);
// Height of the water surface in a partly filled voxel; exact.
float surface_height(glm::ivec3 cell, std::uint32_t byte);

// The first change of medium along `dir` (unit length), at most t_max_vox from the origin.
RayHit trace_ray(const Cells& cells, const RayStart& start, glm::vec3 dir, float t_max_vox);

struct Entry {
    RayStart start;
    float t_entry = 0;  // voxels from the eye to start.origin_vox
};
// The start of a ray from the eye; nothing where it misses the world.
std::optional<Entry> enter_world(const Cells& cells, glm::vec3 origin, glm::vec3 dir);

// Where a hit lies: on its plane exactly, otherwise within the voxel that the ray was in.
glm::vec3 hit_point(const RayStart& start, glm::vec3 dir, const RayHit& hit);

}  // namespace tarn::reference
