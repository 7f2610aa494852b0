#include "app/undo.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace tarn {

namespace {

// How far what flowed on is looked for: sideways and up, down.
constexpr glm::ivec3 flow_reach_vox{64, 8, 64};
constexpr int reach_down_vox = 128;
// Cells looked at, at most: a read-back of 32 MiB.
constexpr std::size_t cells_max = std::size_t{1} << 25;

bool flows(std::uint8_t byte) {
    return is_water(byte) || byte == MATERIAL_SAND;
}

Box box_of(const std::vector<CellChange>& changes, Box box = {glm::ivec3(INT32_MAX), glm::ivec3(0)}) {
    for (const CellChange& change : changes) {
        box.min_vox = glm::min(box.min_vox, change.cell);
        box.max_vox = glm::max(box.max_vox, change.cell + 1);
    }
    return box;
}

Amounts operator-(const Amounts& a, const Amounts& b) {
    return {a.quanta - b.quanta, a.sand - b.sand};
}

}  // namespace

bool undo_stroke(Simulation& simulation, EditHistory& history) {
    const auto changes = history.undo();
    if (!changes) return false;
    Box box = box_of(*changes);
    box.min_vox =
        glm::max(box.min_vox - glm::ivec3(flow_reach_vox.x, reach_down_vox, flow_reach_vox.z), glm::ivec3(0));
    box.max_vox = glm::min(box.max_vox + flow_reach_vox, simulation.size_vox());
    const bool poured =
        std::any_of(changes->begin(), changes->end(), [](const CellChange& c) { return flows(c.before); });
    if (!poured || box.volume() > cells_max) {
        simulation.write(*changes);
        return true;
    }
    const std::vector<std::uint8_t> before = simulation.read_box(box);
    simulation.write(*changes);
    auto elsewhere = flowed_on(*changes, box, before, simulation.read_box(box));
    simulation.write(elsewhere);
    history.took({std::move(elsewhere), amounts_of(before) - amounts_of(simulation.read_box(box))});
    return true;
}

bool redo_stroke(Simulation& simulation, EditHistory& history) {
    const Taken taken = history.release_taken();
    const auto changes = history.redo();
    if (!changes) return false;
    if (taken.elsewhere.empty()) {
        simulation.write(*changes);
        return true;
    }
    const Box box = box_of(taken.elsewhere, box_of(*changes));
    const std::vector<std::uint8_t> before = simulation.read_box(box);
    simulation.write(*changes);
    const std::vector<std::uint8_t> after = simulation.read_box(box);
    simulation.write(given_back(taken, amounts_of(after) - amounts_of(before), box, after));
    return true;
}

}  // namespace tarn
