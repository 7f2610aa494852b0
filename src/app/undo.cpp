#include "app/undo.h"

#include <algorithm>

namespace tarn {

namespace {

// How far what flowed on is looked for: sideways and up, down.
constexpr glm::ivec3 reach_vox{64, 8, 64};
constexpr int reach_down_vox = 128;
// Cells looked at, at most: a read-back of 32 MiB.
constexpr std::size_t cells_max = std::size_t{1} << 25;

bool pours(std::uint8_t byte) {
    return is_water(byte) || byte == MATERIAL_SAND;
}

}  // namespace

bool undo_stroke(Simulation& simulation, EditHistory& history) {
    const auto changes = history.undo();
    if (!changes) return false;
    Box box{simulation.size_vox(), glm::ivec3(0)};
    for (const CellChange& change : *changes) {
        box.min_vox = glm::min(box.min_vox, change.cell);
        box.max_vox = glm::max(box.max_vox, change.cell + 1);
    }
    box.min_vox = glm::max(box.min_vox - glm::ivec3(reach_vox.x, reach_down_vox, reach_vox.z), glm::ivec3(0));
    box.max_vox = glm::min(box.max_vox + reach_vox, simulation.size_vox());
    const bool poured =
        std::any_of(changes->begin(), changes->end(), [](const CellChange& c) { return pours(c.before); });
    if (!poured || box.volume() > cells_max) {
        simulation.write(*changes);
        return true;
    }
    const std::vector<std::uint8_t> before = simulation.read_box(box);
    simulation.write(*changes);
    const auto taken = flowed_on(*changes, box, before, simulation.read_box(box));
    simulation.write(taken);
    history.took(taken);
    return true;
}

bool redo_stroke(Simulation& simulation, EditHistory& history) {
    const auto changes = history.redo();
    if (changes) simulation.write(*changes);
    return changes.has_value();
}

}  // namespace tarn
