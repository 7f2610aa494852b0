// What is drawn over the picture besides the panels: times and counts in a corner, messages, the cross, the
// outline of the brush. Takes no input.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/camera.h"
#include "app/tools.h"
#include "gl/timers.h"
#include "world/cells.h"

namespace tarn {

struct OverlayInputs {
    double frame_ms;
    const std::vector<gl::PassTime>& passes;
    double ticks_per_s;  // achieved
    double ticks_per_s_wanted;
    bool paused;
    std::uint64_t tick;
    glm::ivec3 size_vox;
    const Census& census;
    std::uint32_t active_bricks;
    std::uint64_t samples;
    std::optional<double> error;  // estimated relMSE
    std::uint64_t rejected_samples;
    const Brush& brush;
};

// Times and counts, top left.
void draw_overlay(const OverlayInputs& inputs);

// Lines at the bottom right; nothing for an empty text.
void draw_message(const std::string& text, bool is_error);

// The cross in the middle of the picture, for the captured mouse.
void draw_cross();

// The brush where it will land, in the colour of its material (`color_linear`).
void draw_outline(const View& view, const Brush& brush, glm::ivec3 center_vox, bool removing,
                  glm::vec3 color_linear);

}  // namespace tarn
