#include "reference/flow.h"

#include <algorithm>

#include "world/schedule.h"

namespace tarn {

namespace {

template <typename Act>
void for_cells(const Box& box, const Act& act) {
    for (int z = box.min_vox.z; z < box.max_vox.z; ++z)
        for (int y = box.min_vox.y; y < box.max_vox.y; ++y)
            for (int x = box.min_vox.x; x < box.max_vox.x; ++x) act(glm::ivec3(x, y, z));
}

std::uint64_t due_to_cell(const SpringShare& share, std::uint64_t i) {
    const std::uint64_t turn = (i * share.stride + share.phase) % share.n;
    return turn < share.rest ? std::uint64_t{share.base} + 1 : share.base;
}

}  // namespace

void springs_tick(Cells& cells, const std::vector<Spring>& springs, std::uint32_t seed, std::uint32_t tick,
                  FlowTally& tally) {
    std::uint32_t index = 0;
    for (const Spring& spring : springs) {
        const Box region = clipped(spring.region, cells.size_vox());
        const std::uint32_t spring_index = index++;
        if (region.volume() == 0 || spring.per_tick == 0) continue;
        const SpringShare share = spring_share(spring.per_tick, region.volume(), seed, tick, spring_index);
        std::uint64_t i = 0;
        for_cells(region, [&](glm::ivec3 cell) {
            const std::uint64_t due = due_to_cell(share, i++);
            std::uint8_t& byte = cells.at(cell);
            if (byte != MATERIAL_AIR && !is_water(byte)) return;
            if (spring.material == MATERIAL_SAND) {
                if (byte != MATERIAL_AIR || due == 0) return;
                byte = MATERIAL_SAND;
                ++tally.sprung_sand_voxels;
            } else {
                const std::uint64_t held = quanta_of(byte);
                const std::uint64_t made = std::min(due, QUANTA_PER_VOXEL - held);
                byte = static_cast<std::uint8_t>(water_cell(static_cast<std::uint32_t>(held + made)));
                tally.sprung_water_quanta += made;
            }
        });
    }
}

void drains_tick(Cells& cells, const std::vector<Drain>& drains, FlowTally& tally) {
    for (const Drain& drain : drains)
        for_cells(clipped(drain.region, cells.size_vox()), [&](glm::ivec3 cell) {
            std::uint8_t& byte = cells.at(cell);
            if (is_water(byte)) {
                tally.drained_water_quanta += quanta_of(byte);
                byte = MATERIAL_AIR;
            } else if (byte == MATERIAL_SAND) {
                ++tally.drained_sand_voxels;
                byte = MATERIAL_AIR;
            }
        });
}

}  // namespace tarn
