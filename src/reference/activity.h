// Which parts of the world are awake. A brick sleeps once nothing has changed for SLEEP_TICKS ticks in it and
// its 26 neighbours; a block of cells runs when a brick it touches is awake. Knows no rule of the water.
// A tick here is a step: Settings::water_substeps of them make a tick of the world.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace tarn::reference {

class Activity {
  public:
    // Everything awake.
    explicit Activity(glm::ivec3 size_vox);

    void wake_all();
    void changed(glm::ivec3 cell) { ticks_left_[index(cell)] = full_; }
    // Which bricks are awake in the tick that begins, from the changes before it.
    void begin_tick();
    bool any_awake() const { return any_awake_; }
    // Bricks with a change in the last SLEEP_TICKS ticks.
    std::size_t active_bricks() const { return active_; }
    // Whether the block of cells touches a brick that is awake. It may reach beyond the world.
    bool runs(glm::ivec3 first_vox, glm::ivec3 size_vox) const;
    // From now on nothing sleeps, or again.
    void set_always_awake(bool on) { always_awake_ = on; }

  private:
    std::size_t index(glm::ivec3 cell) const;

    glm::ivec3 size_bricks_;
    std::vector<std::uint8_t> ticks_left_, awake_;  // a brick each, x fastest, then y, then z
    std::uint8_t full_;
    std::size_t active_ = 0;
    bool any_awake_ = true;
    bool always_awake_ = false;
};

}  // namespace tarn::reference
