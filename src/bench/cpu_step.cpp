#include "bench/cpu_step.h"

#include <array>
#include <cstring>

#include "bench/cpu_cells.h"
#include "bench/cpu_lines.h"
#include "core/error.h"
#include "shared/water.h"
#include "world/schedule.h"

namespace tarn {

namespace {

using cpu::Cell;

// A row of blocks along x: `first` is the least cell of its first, which may lie outside.
struct Strip {
    std::uint8_t* bytes;  // of the world
    glm::ivec3 size_vox;
    glm::ivec3 first;
    int by, bz, blocks;
    std::uint32_t seed, tick;
    int film_threshold;
    bool diagonal;

    bool holds_row(int y, int z) const { return y >= 0 && y < size_vox.y && z >= 0 && z < size_vox.z; }
    std::uint8_t* row(int y, int z) const {
        return bytes + std::size_t{1} * size_vox.x * (y + std::size_t{1} * size_vox.y * z);
    }
    std::uint32_t chance(int bx) const {
        return hash4(seed, tick, static_cast<std::uint32_t>(bx | bz << 16), static_cast<std::uint32_t>(by));
    }
};

// `count` cells from x on of the row (y, z), which may lie outside in part or whole.
TARN_INLINE void load_row(const Strip& strip, int x, int y, int z, int count, Cell* to) {
    if (!strip.holds_row(y, z)) {
        std::fill_n(to, count, static_cast<Cell>(cpu::closed));
        return;
    }
    const std::uint8_t* row = strip.row(y, z);
    for (int i = 0; i < count; ++i)
        to[i] = x + i >= 0 && x + i < strip.size_vox.x ? cpu::contents_of_bytes[row[x + i]]
                                                       : static_cast<Cell>(cpu::closed);
}

// Cells of the row that no longer hold what they did.
TARN_INLINE void store_row(const Strip& strip, int x, int y, int z, int count, const Cell* now,
                           const Cell* before) {
    for (int i = 0; i < count; ++i) {
        const int content = cpu::content(now[i]);
        if (content != cpu::content(before[i])) strip.row(y, z)[x + i] = cpu::byte_of(content);
    }
}

constexpr int layer = TALL_SIDE * TALL_SIDE;
constexpr int tall_cells = layer * TALL_HEIGHT;
using Tall = std::array<Cell, tall_cells>;

int tall_index(int x, int y, int z) {
    return x + TALL_SIDE * z + layer * y;
}

// All columns at once: sand sinks, water falls.
TARN_INLINE void fall(Tall& grid) {
    for (int sweep = 0; sweep < 2; ++sweep)
        for (int y = 1; y < TALL_HEIGHT; ++y) {
            Cell* __restrict upper = grid.data() + layer * y;
            Cell* __restrict lower = grid.data() + layer * (y - 1);
            for (int i = 0; i < layer; ++i) {
                const Cell u = upper[i];
                const Cell l = lower[i];
                const auto room = static_cast<Cell>(cpu::full - l);
                Cell moved = u < room ? u : room;
                moved = u <= cpu::full && l < cpu::full ? moved : Cell{0};
                const bool sinks = u == cpu::sand && (sweep == 0 ? l <= cpu::full : l == 0);
                upper[i] = sinks ? l : static_cast<Cell>(u - moved);
                lower[i] = sinks ? static_cast<Cell>(cpu::sand) : static_cast<Cell>(l + moved);
            }
        }
}

// Sand that rests slides to the bottom of a neighbouring column, in sub-blocks of 2x2x2.
TARN_INLINE void slide_sand(Tall& grid, std::uint32_t chance) {
    const std::uint32_t sub = hash2(chance, 99);
    for (int z = static_cast<int>(sub >> 2 & 1u); z + 1 < TALL_SIDE; z += 2)
        for (int y = static_cast<int>(sub >> 1 & 1u); y + 1 < TALL_HEIGHT; y += 2)
            for (int x = static_cast<int>(sub & 1u); x + 1 < TALL_SIDE; x += 2) {
                const int columns[4] = {tall_index(x, y, z), tall_index(x + 1, y, z), tall_index(x, y, z + 1),
                                        tall_index(x + 1, y, z + 1)};
                bool any = false;
                for (const int at : columns) any = any || grid[at + layer] == cpu::sand;
                if (!any) continue;
                const std::uint32_t way = hash4(sub, static_cast<std::uint32_t>(x),
                                                static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z));
                for (std::uint32_t k = 0; k < 4; ++k) {
                    const std::uint32_t i = (k + way) & 3u;
                    const int at = columns[i];
                    if (grid[at + layer] != cpu::sand || cpu::is_open(grid[at])) continue;
                    const bool z_first = (way >> (4 + k) & 1u) != 0;
                    for (const std::uint32_t step : {z_first ? 2u : 1u, z_first ? 1u : 2u}) {
                        const int to = columns[i ^ step];
                        if (!cpu::is_open(grid[to]) || !cpu::is_open(grid[to + layer])) continue;
                        grid[at + layer] = grid[to];
                        grid[to] = static_cast<Cell>(cpu::sand);
                        break;
                    }
                }
            }
}

// What each cell stands on. Of the lowest layer only the world's floor is known.
TARN_INLINE void find_supports(Tall& grid) {
    for (int y = 0; y < TALL_HEIGHT; ++y) {
        Cell* __restrict here = grid.data() + layer * y;
        const Cell* __restrict below = y > 0 ? grid.data() + layer * (y - 1) : nullptr;
        for (int i = 0; i < layer; ++i) {
            const int held = below != nullptr ? cpu::content(below[i]) : cpu::closed;
            here[i] = static_cast<Cell>(cpu::content(here[i]) | cpu::support_of(held));
        }
    }
}

// Where a step along a diagonal of layer y, x going `step_x`, passes between two closed cells.
TARN_INLINE void find_cuts(Tall& grid, int y, int step_x) {
    for (int z = 0; z + 1 < TALL_SIDE; ++z)
        for (int x = std::max(0, -step_x); x < TALL_SIDE - std::max(0, step_x); ++x) {
            const int at = tall_index(x, y, z);
            const bool cut = !cpu::is_open(cpu::content(grid[at + step_x])) &&
                             !cpu::is_open(cpu::content(grid[at + TALL_SIDE]));
            if (cut) grid[at] = static_cast<Cell>(grid[at] | cpu::cut_next);
        }
}

TARN_INLINE bool holds_water(const Cell* cells) {
    bool found = false;
    for (int i = 0; i < layer; ++i) {
        const int content = cpu::content(cells[i]);
        found = found || (content > 0 && content <= cpu::full);
    }
    return found;
}

TARN_INLINE void level_layer(Tall& grid, int y, int direction, const cpu::LineRule& rule,
                             std::uint32_t chance) {
    const int lines = direction < 2 ? TALL_SIDE : 2 * TALL_SIDE - 1;
    for (int number = 0; number < lines; ++number) {
        cpu::Line line{nullptr, 0, TALL_SIDE, 0};
        if (direction == 0) {
            line.first = &grid[tall_index(0, y, number)];
            line.stride = 1;
        } else if (direction == 1) {
            line.first = &grid[tall_index(number, y, 0)];
            line.stride = TALL_SIDE;
        } else {
            // From the side z = 0, then from the side where x does not change.
            const bool rising = direction == 2;
            const int along = std::min(number, TALL_SIDE - 1);
            const int x = rising ? TALL_SIDE - 1 - along : along;
            const int z = std::max(0, number - TALL_SIDE + 1);
            line.first = &grid[tall_index(x, y, z)];
            line.stride = (rising ? 1 : -1) + TALL_SIDE;
            line.count = std::min(rising ? TALL_SIDE - x : x + 1, TALL_SIDE - z);
        }
        cpu::level_line(line, rule, cpu::line_chance(chance, direction, y, number));
    }
}

TARN_INLINE void tall_block(const Strip& strip, int bx) {
    const int x = strip.first.x + bx * TALL_SIDE;
    const std::uint32_t chance = strip.chance(bx);
    alignas(32) Tall grid;
    for (int y = 0; y < TALL_HEIGHT; ++y)
        for (int z = 0; z < TALL_SIDE; ++z)
            load_row(strip, x, strip.first.y + y, strip.first.z + z, TALL_SIDE, &grid[tall_index(0, y, z)]);
    alignas(32) const Tall before = grid;
    fall(grid);
    slide_sand(grid, chance);
    const cpu::LineRule rule{strip.film_threshold, 0, strip.diagonal ? 2 : 1};
    for (int pass = 0; pass < 2; ++pass) {
        const int direction = strip.diagonal
                                  ? ((chance >> 29 & 1u) == static_cast<std::uint32_t>(pass) ? 2 : 3)
                                  : ((chance >> 30 & 1u) == static_cast<std::uint32_t>(pass) ? 0 : 1);
        find_supports(grid);
        for (int y = strip.first.y == 0 ? 0 : 1; y < TALL_HEIGHT; ++y) {
            if (!holds_water(grid.data() + layer * y)) continue;
            if (strip.diagonal) find_cuts(grid, y, direction == 2 ? 1 : -1);
            level_layer(grid, y, direction, rule, chance);
        }
    }
    for (int y = 0; y < TALL_HEIGHT; ++y)
        for (int z = 0; z < TALL_SIDE; ++z)
            store_row(strip, x, strip.first.y + y, strip.first.z + z, TALL_SIDE, &grid[tall_index(0, y, z)],
                      &before[tall_index(0, y, z)]);
}

TARN_INLINE void wide_block(const Strip& strip, int bx) {
    constexpr int side = WIDE_SIDE;
    const int x = strip.first.x + bx * side;
    const int y = strip.first.y + 1;
    const std::uint32_t chance = strip.chance(bx);
    alignas(32) std::array<Cell, side * side> grid;
    std::array<Cell, side> below;
    for (int z = 0; z < side; ++z) {
        Cell* row = &grid[side * z];
        load_row(strip, x, y, strip.first.z + z, side, row);
        load_row(strip, x, y - 1, strip.first.z + z, side, below.data());
        for (int i = 0; i < side; ++i) row[i] = static_cast<Cell>(row[i] | cpu::support_of(below[i]));
    }
    alignas(32) const std::array<Cell, side* side> before = grid;
    const cpu::LineRule rule{strip.film_threshold, WIDE_LEAST_QUANTA, 1};
    for (int pass = 0; pass < 2; ++pass) {
        const bool along_x = (chance >> 30 & 1u) == static_cast<std::uint32_t>(pass);
        for (int i = 0; i < side; ++i)
            cpu::level_line({&grid[along_x ? side * i : i], along_x ? 1 : side, side, 0}, rule,
                            cpu::line_chance(chance, along_x ? 0 : 1, 1, i));
    }
    for (int z = 0; z < side; ++z)
        store_row(strip, x, y, strip.first.z + z, side, &grid[side * z], &before[side * z]);
}

// Runs the blocks of a strip in which anything can move.
template <typename Bytes, bool tall>
TARN_INLINE void run_strip(const Strip& strip) {
    constexpr int side = tall ? TALL_SIDE : WIDE_SIDE;
    cpu::Found found;
    std::fill_n(found.moves.begin(), strip.size_vox.x, std::uint8_t{0});
    std::fill_n(found.room.begin(), strip.size_vox.x, std::uint8_t{0});
    for (int z = 0; z < side; ++z)
        for (int y = tall ? 0 : 1; y < (tall ? TALL_HEIGHT : WIDE_HEIGHT); ++y)
            if (strip.holds_row(strip.first.y + y, strip.first.z + z))
                cpu::find_matter<Bytes>(strip.row(strip.first.y + y, strip.first.z + z), strip.size_vox.x,
                                        found);
    for (int bx = 0; bx < strip.blocks; ++bx) {
        const int x = strip.first.x + bx * side;
        const int from = std::max(x, 0);
        const int end = std::min(x + side, strip.size_vox.x);
        if (!cpu::any_in(found.moves, from, end) || !cpu::any_in(found.room, from, end)) continue;
        if constexpr (tall)
            tall_block(strip, bx);
        else
            wide_block(strip, bx);
    }
}

void run_tall_plain(const Strip& strip) {
    run_strip<cpu::Bytes16, true>(strip);
}
void run_wide_plain(const Strip& strip) {
    run_strip<cpu::Bytes16, false>(strip);
}
#if defined(__x86_64__)
__attribute__((target("avx2"))) void run_tall_avx2(const Strip& strip) {
    run_strip<cpu::Bytes32, true>(strip);
}
__attribute__((target("avx2"))) void run_wide_avx2(const Strip& strip) {
    run_strip<cpu::Bytes32, false>(strip);
}
#endif

using RunStrip = void (*)(const Strip&);

RunStrip runner(bool tall, CpuVectors vectors) {
#if defined(__x86_64__)
    if (vectors == CpuVectors::Avx2) return tall ? run_tall_avx2 : run_wide_avx2;
#endif
    CHECK(vectors == CpuVectors::Plain);
    return tall ? run_tall_plain : run_wide_plain;
}

// Blocks of one grid share no cell: strips of them go to whichever thread is free.
void run_blocks(Cells& cells, glm::ivec3 block, std::uint32_t seed, std::uint32_t tick, const CpuStep& step,
                RunStrip run) {
    const glm::ivec3 size = cells.size_vox();
    const glm::ivec3 offset = block_offset_vox(seed, tick, block);
    const glm::ivec3 count = (size + offset + block - 1) / block;
    cpu::for_each(count.y * count.z, step.threads, [&](int i) {
        const int by = i % count.y;
        const int bz = i / count.y;
        run({.bytes = cells.bytes().data(),
             .size_vox = size,
             .first = glm::ivec3(0, by, bz) * block - offset,
             .by = by,
             .bz = bz,
             .blocks = count.x,
             .seed = seed,
             .tick = tick,
             .film_threshold = step.film_threshold,
             .diagonal = hash2(step.seed ^ SALT_DIAGONAL, tick) % 3 == 0});
    });
}

}  // namespace

bool has_vectors(CpuVectors vectors) {
#if defined(__x86_64__)
    if (vectors == CpuVectors::Avx2) return __builtin_cpu_supports("avx2") != 0;
#endif
    return vectors == CpuVectors::Plain;
}

void cpu_level_tick(Cells& cells, std::uint32_t tick, const CpuStep& step) {
    CHECK(cells.size_vox().x <= world_side_max_vox && has_vectors(step.vectors));
    run_blocks(cells, {TALL_SIDE, TALL_HEIGHT, TALL_SIDE}, step.seed, tick, step, runner(true, step.vectors));
    run_blocks(cells, {WIDE_SIDE, WIDE_HEIGHT, WIDE_SIDE}, step.seed ^ SALT_WIDE, tick, step,
               runner(false, step.vectors));
}

}  // namespace tarn
