#include "reference/simulation.h"

#include "reference/water_block.h"
#include "reference/water_level.h"

namespace tarn::reference {

Simulation::Simulation(const Scene& scene, std::uint64_t tick)
    : cells_(scene.cells),
      seed_(scene.seed),
      springs_(scene.springs),
      drains_(scene.drains),
      tick_(tick),
      step_(tick),
      activity_(cells_.size_vox()) {}

void Simulation::step(int n, const Settings& settings) {
    for (int i = 0; i < n; ++i, ++tick_)
        for (int k = 0; k < settings.water_substeps; ++k, ++step_)
            step_once(settings, k == 0, k + 1 == settings.water_substeps);
}

void Simulation::write(glm::ivec3 cell, std::uint8_t byte) {
    if (cells_.at(cell) == byte) return;
    cells_.at(cell) = byte;
    activity_.changed(cell);
}

template <typename Act>
void Simulation::noting_changes(const Act& act) {
    const Cells before = cells_;
    act();
    const glm::ivec3 size = cells_.size_vox();
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (cells_.at({x, y, z}) != before.at({x, y, z})) activity_.changed({x, y, z});
}

void Simulation::step_once(const Settings& settings, bool springs_run, bool drains_run) {
    const auto step = static_cast<std::uint32_t>(step_);
    const bool other_rule =
        tier_ && (*tier_ != settings.water_tier || film_threshold_ != settings.film_threshold);
    if (other_rule) activity_.wake_all();
    tier_ = settings.water_tier;
    film_threshold_ = settings.film_threshold;
    if (*tier_ != WaterTier::Pressure) field_.reset();
    if (*tier_ == WaterTier::Pressure && !field_) field_.emplace(cells_.size_vox());

    activity_.begin_tick();
    for (int i = 0; field_ && activity_.any_awake() && i < settings.pressure_sweeps; ++i)
        field_->sweep(cells_, activity_, film_threshold_);
    if (springs_run && !springs_.empty())
        noting_changes([&] { springs_tick(cells_, springs_, seed_, step, flow_); });
    if (*tier_ == WaterTier::Block)
        water_block_tick(cells_, seed_, step, film_threshold_, activity_);
    else
        water_level_tick(cells_, seed_, step, film_threshold_, activity_, field_ ? &*field_ : nullptr);
    if (drains_run && !drains_.empty()) noting_changes([&] { drains_tick(cells_, drains_, flow_); });
}

}  // namespace tarn::reference
