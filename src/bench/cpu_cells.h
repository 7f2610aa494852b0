// What the steps of the CPU share: how they read cells, find where anything can move, and split work among
// threads. All inline, so that each set of vector instructions gets its own.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

#include "shared/materials.h"
#include "shared/water.h"
#include "world/cells.h"

namespace tarn::cpu {

// What a cell holds: 0..full quanta of water (0: air), sand, or closed (solid, or beyond the world).
constexpr int full = static_cast<int>(QUANTA_PER_VOXEL);
constexpr int sand = 32;
constexpr int closed = 64;

using Cell = std::int16_t;

inline bool is_open(int content) {
    return content <= full;
}

// Cells at once in a register of SSE2 and of AVX2.
using Bytes16 = std::uint8_t __attribute__((vector_size(16)));
using Bytes32 = std::uint8_t __attribute__((vector_size(32)));
constexpr int row_max = world_side_max_vox + 2 * WIDE_SIDE;  // cells, with what lies beyond the world

// The vectors that AVX2 code passes around stay inside functions that are inlined into it.
#define TARN_INLINE inline __attribute__((always_inline))

// By cell of a row of the world: whether it moves, and whether it is room to move in (neither solid nor full
// water).
struct alignas(32) Found {
    std::array<std::uint8_t, row_max> moves, room;
};

template <typename Bytes>
TARN_INLINE void find_matter(const std::uint8_t* row, int n, Found& found) {
    constexpr int lanes = sizeof(Bytes);
    int x = 0;
    for (; x + lanes <= n; x += lanes) {
        Bytes cells;
        Bytes moves;
        Bytes room;
        std::memcpy(&cells, row + x, lanes);
        std::memcpy(&moves, found.moves.data() + x, lanes);
        std::memcpy(&room, found.room.data() + x, lanes);
        const Bytes matter = reinterpret_cast<Bytes>((cells & 0xf0) == MATERIAL_WATER) |
                             reinterpret_cast<Bytes>(cells == MATERIAL_SAND);
        moves |= matter;
        room |= (matter & reinterpret_cast<Bytes>(cells != MATERIAL_WATER_FULL)) |
                reinterpret_cast<Bytes>(cells == MATERIAL_AIR);
        std::memcpy(found.moves.data() + x, &moves, lanes);
        std::memcpy(found.room.data() + x, &room, lanes);
    }
    for (; x < n; ++x) {
        const bool matter = is_water(row[x]) || row[x] == MATERIAL_SAND;
        if (matter) found.moves[x] = 0xff;
        if (row[x] == MATERIAL_AIR || (matter && row[x] != MATERIAL_WATER_FULL)) found.room[x] = 0xff;
    }
}

TARN_INLINE bool any_in(const std::array<std::uint8_t, row_max>& flags, int from, int end) {
    bool found = false;
    for (int x = from; x < end; ++x) found = found || flags[x] != 0;
    return found;
}

using Contents = std::array<Cell, 256>;
constexpr Contents make_contents() {
    Contents contents{};
    for (int byte = 0; byte < 256; ++byte) {
        const auto b = static_cast<std::uint32_t>(byte);
        contents[byte] = static_cast<Cell>(b == MATERIAL_AIR    ? 0
                                           : b == MATERIAL_SAND ? sand
                                           : is_water(b)        ? static_cast<int>(quanta_of(b))
                                                                : closed);
    }
    return contents;
}
inline constexpr Contents contents_of_bytes = make_contents();

inline std::uint8_t byte_of(int content) {
    return static_cast<std::uint8_t>(content == sand ? MATERIAL_SAND
                                                     : water_cell(static_cast<std::uint32_t>(content)));
}

// Calls act(i) for i = 0 .. count - 1, each on whichever thread is free.
template <typename Act>
void for_each(int count, int threads, const Act& act) {
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) act(i);
    };
    std::vector<std::thread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
}

}  // namespace tarn::cpu
