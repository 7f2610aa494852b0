// Where the water and the sand of a stroke went that flowed on since.
#include <algorithm>
#include <deque>

#include "core/error.h"
#include "world/edits.h"

namespace tarn {

namespace {

constexpr std::uint8_t water_none = MATERIAL_WATER_FULL - QUANTA_PER_VOXEL;  // plus quanta: a cell of water

struct Amounts {
    std::int64_t quanta = 0, sand = 0;
    void add(std::uint8_t byte, int sign) {
        quanta += sign * static_cast<std::int64_t>(quanta_of(byte));
        sand += byte == MATERIAL_SAND ? sign : 0;
    }
};

bool is_open(std::uint8_t byte) {
    return byte == MATERIAL_AIR || is_water(byte) || byte == MATERIAL_SAND;
}

}  // namespace

std::vector<CellChange> flowed_on(const std::vector<CellChange>& undone, const Box& box,
                                  const std::vector<std::uint8_t>& before,
                                  const std::vector<std::uint8_t>& after) {
    const glm::ivec3 size = box.size();
    CHECK(before.size() == box.volume() && after.size() == before.size());
    const auto index = [&](glm::ivec3 at) {
        return at.x + std::size_t{1} * size.x * (at.y + std::size_t{1} * size.y * at.z);
    };
    Amounts left;  // to take
    std::vector<char> seen(after.size(), 0);
    std::deque<glm::ivec3> open;
    for (const CellChange& change : undone) {
        left.add(change.before, 1);
        left.add(change.after, -1);
        const glm::ivec3 at = change.cell - box.min_vox;
        char& known = seen[index(at)];
        if (known != 0) continue;
        known = 1;
        left.add(before[index(at)], -1);
        left.add(after[index(at)], 1);
        if (is_open(after[index(at)])) open.push_back(at);
    }
    // What was there before the stroke stays: its own cells are as they were.
    std::fill(seen.begin(), seen.end(), 0);
    for (const CellChange& change : undone) seen[index(change.cell - box.min_vox)] = 2;

    std::vector<CellChange> taken;
    while (!open.empty() && (left.quanta > 0 || left.sand > 0)) {
        const glm::ivec3 at = open.front();
        open.pop_front();
        char& state = seen[index(at)];
        if (state == 1) continue;
        const std::uint8_t byte = after[index(at)];
        if (state == 0) {
            if (is_water(byte) && left.quanta > 0) {
                const auto quanta = std::min<std::int64_t>(left.quanta, quanta_of(byte));
                const auto rest = static_cast<std::uint8_t>(quanta_of(byte) - quanta);
                left.quanta -= quanta;
                taken.push_back({box.min_vox + at, byte,
                                 static_cast<std::uint8_t>(rest == 0 ? MATERIAL_AIR : water_none + rest)});
            } else if (byte == MATERIAL_SAND && left.sand > 0) {
                --left.sand;
                taken.push_back({box.min_vox + at, byte, static_cast<std::uint8_t>(MATERIAL_AIR)});
            }
        }
        state = 1;
        for (int side = 0; side < 6; ++side) {
            glm::ivec3 next = at;
            next[side / 2] += side % 2 == 0 ? -1 : 1;
            const int axis = side / 2;
            if (next[axis] < 0 || next[axis] >= size[axis]) continue;
            if (seen[index(next)] == 1 || !is_open(after[index(next)])) continue;
            if (side == 2)
                open.push_front(next);
            else
                open.push_back(next);
        }
    }
    return taken;
}

}  // namespace tarn
