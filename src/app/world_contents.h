// What the world of a simulation may hold by now, without looking at its cells: decides what code a picture
// needs.
#pragma once
#include <cstdint>
#include <vector>

#include "app/simulation.h"
#include "world/material_table.h"

namespace tarn {

class WorldContents {
  public:
    explicit WorldContents(const Scene& scene);

    // What the world held at its start, what was built since, and what springs make: more than is there now
    // at most.
    bool may_hold(const Simulation& simulation, std::size_t id) const;
    // Voxels of emissive materials that edits placed and removed.
    std::uint64_t emissive_edits(const Simulation& simulation, const MaterialTable& materials) const;

  private:
    Census initial_;
    std::vector<Spring> springs_;
};

}  // namespace tarn
