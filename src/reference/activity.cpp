#include "reference/activity.h"

#include <algorithm>

#include "shared/bindings.h"
#include "shared/water.h"

namespace tarn::reference {

Activity::Activity(glm::ivec3 size_vox)
    : size_bricks_((size_vox + BRICK_SIDE - 1) / BRICK_SIDE),
      ticks_left_(std::size_t{1} * size_bricks_.x * size_bricks_.y * size_bricks_.z, SLEEP_TICKS),
      awake_(ticks_left_.size(), 1),
      full_(SLEEP_TICKS) {}

std::size_t Activity::index(glm::ivec3 cell) const {
    const glm::ivec3 brick = cell / BRICK_SIDE;
    return brick.x + std::size_t{1} * size_bricks_.x * (brick.y + std::size_t{1} * size_bricks_.y * brick.z);
}

void Activity::wake_all() {
    std::fill(ticks_left_.begin(), ticks_left_.end(), full_);
}

void Activity::begin_tick() {
    std::fill(awake_.begin(), awake_.end(), std::uint8_t{0});
    active_ = 0;
    std::size_t i = 0;
    for (int z = 0; z < size_bricks_.z; ++z)
        for (int y = 0; y < size_bricks_.y; ++y)
            for (int x = 0; x < size_bricks_.x; ++x, ++i) {
                if (ticks_left_[i] == 0) continue;
                --ticks_left_[i];
                ++active_;
                const glm::ivec3 low = glm::max(glm::ivec3(x, y, z) - 1, glm::ivec3(0));
                const glm::ivec3 high = glm::min(glm::ivec3(x, y, z) + 1, size_bricks_ - 1);
                for (int c = low.z; c <= high.z; ++c)
                    for (int b = low.y; b <= high.y; ++b)
                        for (int a = low.x; a <= high.x; ++a)
                            awake_[a + std::size_t{1} * size_bricks_.x *
                                           (b + std::size_t{1} * size_bricks_.y * c)] = 1;
            }
    any_awake_ = active_ > 0 || always_awake_;
}

bool Activity::runs(glm::ivec3 first_vox, glm::ivec3 size_vox) const {
    if (always_awake_) return true;
    const glm::ivec3 low = glm::max(first_vox, glm::ivec3(0)) / BRICK_SIDE;
    const glm::ivec3 high = glm::min((first_vox + size_vox - 1) / BRICK_SIDE, size_bricks_ - 1);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x)
                if (awake_[x + std::size_t{1} * size_bricks_.x * (y + std::size_t{1} * size_bricks_.y * z)])
                    return true;
    return false;
}

}  // namespace tarn::reference
