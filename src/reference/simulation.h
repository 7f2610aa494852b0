// A world that moves, in plain serial code: what app/simulation.h must do with its cells, byte for byte.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/settings.h"
#include "reference/activity.h"
#include "reference/flow.h"
#include "reference/pressure_field.h"
#include "world/cells.h"
#include "world/scene.h"

namespace tarn::reference {

class Simulation {
  public:
    explicit Simulation(const Scene& scene, std::uint64_t tick = 0);

    // n ticks under settings.water_tier, film_threshold, water_substeps and pressure_sweeps.
    void step(int n, const Settings& settings);
    // Between ticks.
    void write(glm::ivec3 cell, std::uint8_t byte);
    void set_always_awake(bool on) { activity_.set_always_awake(on); }

    const Cells& cells() const { return cells_; }
    std::uint64_t tick() const { return tick_; }
    const FlowTally& flow() const { return flow_; }
    // Bricks with a change in the last SLEEP_TICKS steps.
    std::size_t active_bricks() const { return activity_.active_bricks(); }

  private:
    void step_once(const Settings& settings, bool springs_run, bool drains_run);
    // Runs `act`, which knows no activity, and tells what it changed.
    template <typename Act>
    void noting_changes(const Act& act);

    Cells cells_;
    std::uint32_t seed_;
    std::vector<Spring> springs_;
    std::vector<Drain> drains_;
    std::uint64_t tick_, step_;
    FlowTally flow_;
    Activity activity_;
    std::optional<PressureField> field_;
    std::optional<WaterTier> tier_;
    int film_threshold_ = 0;
};

}  // namespace tarn::reference
