// The head of confined water in plain serial code. Built by sweeps along whole lines of the world, one axis
// each time it runs; once a round over the three axes finds nothing new, it becomes the head that acts on the
// water.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/activity.h"
#include "world/cells.h"

namespace tarn::reference {

// Head of a cell: height of the free surface that feeds it in quarter voxels, then how many steps of the way
// from there are left (so that along a way from the surface the number falls), then whether the way is open
// to the sky. 0: none. Greater wins.
constexpr std::uint32_t head_open = 1;
constexpr std::uint32_t head_step = 2;
constexpr int head_reach_bits = 10;
constexpr std::uint32_t head_reach_mask = ((1u << head_reach_bits) - 1) << 1;
constexpr int head_height_shift = head_reach_bits + 1;
constexpr int head_per_voxel = 4;

constexpr int height_of(std::uint32_t head) {
    return static_cast<int>(head >> head_height_shift);
}
// Whether water under that head has passed a ceiling: only then does it press.
constexpr bool is_confined(std::uint32_t head) {
    return head != 0 && (head & head_open) == 0;
}
// Whether the head of a cell in layer y stands more than a voxel above it.
constexpr bool is_pressed(std::uint32_t head, int y) {
    return is_confined(head) && height_of(head) >= (y + 2) * head_per_voxel;
}

class PressureField {
  public:
    explicit PressureField(glm::ivec3 size_vox);

    std::uint32_t acting(glm::ivec3 cell) const { return acting_[index(cell)]; }
    void set_acting(glm::ivec3 cell, std::uint32_t head) { acting_[index(cell)] = head; }
    // At the start of a step, once or more often: one sweep; wakes bricks in which a new head moves water.
    // Not called while nothing is awake.
    void sweep(const Cells& cells, Activity& activity, int film_threshold);

  private:
    std::size_t index(glm::ivec3 cell) const {
        return cell.x + std::size_t{1} * size_.x * (cell.y + std::size_t{1} * size_.y * cell.z);
    }
    bool sweep_lines(const Cells& cells, int axis, bool seed, int film_threshold);
    void publish(Activity& activity);

    glm::ivec3 size_;
    std::vector<std::uint32_t> acting_, building_;
    int sweeps_ = 0;        // since the field began to be built
    int quiet_sweeps_ = 0;  // that found nothing new, up to the last but one
    bool found_ = false;    // by the last
};

}  // namespace tarn::reference
