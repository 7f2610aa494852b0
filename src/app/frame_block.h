// Fills the per-frame uniform block (glsl/shared/frame.h) from settings; the only place that knows its units.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "core/settings.h"
#include "shared/frame.h"
#include "world/material_table.h"

namespace tarn {

struct FrameInputs {
    const Settings& settings;
    glm::ivec3 world_size_vox;
    float metres_per_voxel;
    std::uint32_t seed;
    std::uint32_t frame_index;
    std::uint32_t frames_kept;  // summed so far in exact mode
    glm::ivec2 traced_px, shown_px;
    bool scattered = false;  // each traced pixel stands for one shown pixel, another one in each frame
};

FrameBlock make_frame_block(const FrameInputs& inputs);

// Copies the eye of `before` into the previous_* fields of `now`.
void set_previous_eye(FrameBlock& now, const FrameBlock& before);

// One material as the shaders lay it out (std140).
struct MaterialBlockEntry {
    glm::vec4 base_roughness, absorption_ior, emission_metallic;
};
std::array<MaterialBlockEntry, MATERIAL_COUNT> make_material_block(const MaterialTable& table);

}  // namespace tarn
