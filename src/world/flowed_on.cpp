// Where the water and the sand of a stroke went that flowed on since.
#include <algorithm>
#include <deque>

#include "core/error.h"
#include "world/edits.h"

namespace tarn {

namespace {

constexpr std::int64_t full = QUANTA_PER_VOXEL;
constexpr std::uint8_t water_none = MATERIAL_WATER_FULL - QUANTA_PER_VOXEL;  // plus quanta: a cell of water

void add(Amounts& amounts, std::uint8_t byte, int sign) {
    amounts.quanta += sign * static_cast<std::int64_t>(quanta_of(byte));
    amounts.sand += byte == MATERIAL_SAND ? sign : 0;
}

std::uint8_t water_of(std::int64_t quanta) {
    return static_cast<std::uint8_t>(quanta == 0 ? MATERIAL_AIR : water_none + quanta);
}

bool is_open(std::uint8_t byte) {
    return byte == MATERIAL_AIR || is_water(byte) || byte == MATERIAL_SAND;
}

}  // namespace

Amounts amounts_of(const std::vector<std::uint8_t>& bytes) {
    Amounts amounts;
    for (const std::uint8_t byte : bytes) add(amounts, byte, 1);
    return amounts;
}

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
        add(left, change.before, 1);
        add(left, change.after, -1);
        const glm::ivec3 at = change.cell - box.min_vox;
        char& known = seen[index(at)];
        if (known != 0) continue;
        known = 1;
        add(left, before[index(at)], -1);
        add(left, after[index(at)], 1);
        if (is_open(after[index(at)])) open.push_back(at);
    }
    // What was there before the stroke stays: its own cells are as they were.
    std::fill(seen.begin(), seen.end(), 0);
    Amounts there = amounts_of(after);
    for (const CellChange& change : undone) {
        char& state = seen[index(change.cell - box.min_vox)];
        if (state == 0) add(there, after[index(change.cell - box.min_vox)], -1);
        state = 2;
    }
    // What has left the box, by a drain say, is not looked for.
    left.quanta = std::min(left.quanta, there.quanta);
    left.sand = std::min(left.sand, there.sand);

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
                left.quanta -= quanta;
                taken.push_back({box.min_vox + at, byte, water_of(quanta_of(byte) - quanta)});
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

std::vector<CellChange> given_back(const Taken& taken, Amounts rewritten, const Box& box,
                                   const std::vector<std::uint8_t>& after) {
    const glm::ivec3 size = box.size();
    CHECK(after.size() == box.volume());
    Amounts left{taken.in_all.quanta - rewritten.quanta, taken.in_all.sand - rewritten.sand};
    std::vector<std::uint8_t> now = after;
    std::vector<CellChange> given;
    // Each cell what was taken there, and then whatever it has room for.
    for (const bool all : {false, true})
        for (const CellChange& change : taken.elsewhere) {
            const glm::ivec3 at = change.cell - box.min_vox;
            std::uint8_t& byte =
                now[at.x + std::size_t{1} * size.x * (at.y + std::size_t{1} * size.y * at.z)];
            const std::uint8_t before = byte;
            if (change.before == MATERIAL_SAND && left.sand > 0 && byte == MATERIAL_AIR) {
                byte = MATERIAL_SAND;
                --left.sand;
            } else if (is_water(change.before) && left.quanta > 0 &&
                       (byte == MATERIAL_AIR || is_water(byte))) {
                const std::int64_t most =
                    all ? full : std::int64_t{quanta_of(change.before)} - quanta_of(change.after);
                const std::int64_t quanta = std::min({left.quanta, most, full - quanta_of(byte)});
                byte = water_of(quanta_of(byte) + quanta);
                left.quanta -= quanta;
            }
            if (byte != before) given.push_back({change.cell, before, byte});
        }
    return given;
}

}  // namespace tarn
