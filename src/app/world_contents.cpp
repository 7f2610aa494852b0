#include "app/world_contents.h"

#include <algorithm>

namespace tarn {

WorldContents::WorldContents(const Scene& scene)
    : initial_(take_census(scene.cells)), springs_(scene.springs) {}

bool WorldContents::may_hold(const Simulation& simulation, std::size_t id) const {
    return initial_.voxels[id] > 0 || simulation.edit_totals().placed.voxels[id] > 0 ||
           std::any_of(springs_.begin(), springs_.end(),
                       [&](const Spring& spring) { return spring.material == id; });
}

std::uint64_t WorldContents::emissive_edits(const Simulation& simulation,
                                            const MaterialTable& materials) const {
    const EditTotals& edits = simulation.edit_totals();
    std::uint64_t sum = 0;
    for (std::size_t id = 0; id < materials.size(); ++id) {
        if (shines(materials[id])) sum += edits.placed.voxels[id] + edits.removed.voxels[id];
    }
    return sum;
}

}  // namespace tarn
