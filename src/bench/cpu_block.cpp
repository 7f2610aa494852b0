// The `block` tier on the CPU: the rule of glsl/pass/block_step.comp.
#include <algorithm>
#include <array>
#include <cstdlib>

#include "bench/cpu_cells.h"
#include "bench/cpu_step.h"
#include "core/error.h"
#include "shared/hash.h"
#include "world/schedule.h"

namespace tarn {

namespace {

using cpu::Cell;

// Cell k of a block: (k & 1) along a, (k >> 1 & 1) along b, its horizontal axes in a frame mirrored and
// transposed by hash, (k >> 2) up.
using Block = std::array<int, 8>;

struct Rule {
    std::uint32_t seed, tick_key;  // hash2(seed, tick)
    int film_threshold;
};

TARN_INLINE void fall(int& upper, int& lower) {
    if (!cpu::is_open(lower)) return;
    if (upper == cpu::sand) {
        std::swap(upper, lower);
    } else if (cpu::is_open(upper)) {
        const int moved = std::min(upper, cpu::full - lower);
        upper -= moved;
        lower += moved;
    }
}

// Sand on top of column `from` slides to the bottom of `to`.
TARN_INLINE void slide(Block& c, int from, int to) {
    if (c[from + 4] != cpu::sand || cpu::is_open(c[from]) || !cpu::is_open(c[to + 4]) || !cpu::is_open(c[to]))
        return;
    c[from + 4] = c[to];
    c[to] = cpu::sand;
}

TARN_INLINE void slide_both(Block& c, int one, int other) {
    slide(c, one, other);
    slide(c, other, one);
}

TARN_INLINE void level(int& a, int& b, bool a_stands, bool b_stands, int film_threshold) {
    if (!cpu::is_open(a) || !cpu::is_open(b)) return;
    const int total = a + b;
    if (a_stands && b_stands) {
        if (std::abs(a - b) <= 1 || (std::min(a, b) == 0 && total < 2 * film_threshold)) return;
        a = total / 2;
    } else if (a_stands) {
        a = total - std::min(total, cpu::full);
    } else if (b_stands) {
        a = std::min(total, cpu::full);
    }
    b = total - a;
}

// Cells `first` .. first + 3 of a layer; one tick in four those that all stand level at once.
TARN_INLINE void level_layer(Block& c, int first, const std::array<bool, 4>& stands, bool as_one,
                             int film_threshold) {
    int* const cells = c.data() + first;
    const int most = *std::max_element(cells, cells + 4);
    const int least = *std::min_element(cells, cells + 4);
    if (as_one && stands[0] && stands[1] && stands[2] && stands[3] && cpu::is_open(most)) {
        if (most - least <= 1) return;
        const int total = cells[0] + cells[1] + cells[2] + cells[3];
        if (least > 0 || total >= 4 * film_threshold) {
            for (int k = 0; k < 4; ++k) cells[k] = (total + 3 - k) / 4;
            return;
        }
    }
    constexpr int pairs[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    for (const auto& [a, b] : pairs) level(cells[a], cells[b], stands[a], stands[b], film_threshold);
}

TARN_INLINE void run_rule(Block& c, glm::ivec3 first, std::uint32_t h, const Rule& rule) {
    for (int k = 0; k < 4; ++k) fall(c[k + 4], c[k]);
    if (std::find(c.begin(), c.end(), cpu::sand) != c.end()) {
        slide_both(c, 0, 1);
        slide_both(c, 2, 3);
        slide_both(c, 0, 2);
        slide_both(c, 1, 3);
        // Diagonally at half of all places, for good; never between two closed columns.
        const std::uint32_t ways = hash3(rule.seed, static_cast<std::uint32_t>(first.x + 1),
                                         static_cast<std::uint32_t>(first.z + 1));
        const std::uint32_t way = (h ^ h >> 1) & 1u;
        if ((ways >> way & 1u) != 0 && (cpu::is_open(c[5]) || cpu::is_open(c[6]))) slide_both(c, 0, 3);
        if ((ways >> (1 - way) & 1u) != 0 && (cpu::is_open(c[4]) || cpu::is_open(c[7]))) slide_both(c, 1, 2);
    }
    const bool as_one = (h >> 3 & 3u) == 0;
    // What the lower layer rests on is not seen here, but for the world's floor.
    if (first.y == 0) level_layer(c, 0, {true, true, true, true}, as_one, rule.film_threshold);
    level_layer(c, 4, {c[0] >= cpu::full, c[1] >= cpu::full, c[2] >= cpu::full, c[3] >= cpu::full}, as_one,
                rule.film_threshold);
}

// The rows of a line of blocks along x, [layer][z]; null beyond the world.
using Rows = std::array<std::array<std::uint8_t*, 2>, 2>;

TARN_INLINE void run_block(const Rows& rows, int size_x, glm::ivec3 first, const Rule& rule) {
    const std::uint32_t h =
        hash3(rule.tick_key,
              static_cast<std::uint32_t>(first.x + 1) | static_cast<std::uint32_t>(first.z + 1) << 16,
              static_cast<std::uint32_t>(first.y + 1));
    const int mirror_x = static_cast<int>(h & 1u);
    const int mirror_z = static_cast<int>(h >> 1 & 1u);
    const bool transposed = (h & 4u) != 0;
    std::array<std::uint8_t*, 8> at{};
    Block c;
    for (int k = 0; k < 8; ++k) {
        const int a = k & 1;
        const int b = k >> 1 & 1;
        const int x = first.x + ((transposed ? b : a) ^ mirror_x);
        std::uint8_t* const row = rows[k >> 2][(transposed ? a : b) ^ mirror_z];
        at[k] = row != nullptr && x >= 0 && x < size_x ? row + x : nullptr;
        c[k] = at[k] != nullptr ? cpu::contents_of_bytes[*at[k]] : cpu::closed;
    }
    const Block before = c;
    run_rule(c, first, h, rule);
    for (int k = 0; k < 8; ++k)
        if (c[k] != before[k]) *at[k] = cpu::byte_of(c[k]);
}

struct Plane {
    std::uint8_t* bytes;  // of the world
    glm::ivec3 size_vox, offset_vox;
    int z;
    Rule rule;
};

// The blocks that begin in one plane z.
template <typename Bytes>
TARN_INLINE void run_plane(const Plane& plane) {
    const glm::ivec3 size = plane.size_vox;
    cpu::Found found;
    for (int y = -plane.offset_vox.y; y < size.y; y += 2) {
        Rows rows{};
        std::fill_n(found.moves.begin(), size.x, std::uint8_t{0});
        std::fill_n(found.room.begin(), size.x, std::uint8_t{0});
        for (int k = 0; k < 4; ++k) {
            const glm::ivec2 yz(y + (k >> 1), plane.z + (k & 1));
            if (yz.x < 0 || yz.x >= size.y || yz.y < 0 || yz.y >= size.z) continue;
            rows[k >> 1][k & 1] =
                plane.bytes + std::size_t{1} * size.x * (yz.x + std::size_t{1} * size.y * yz.y);
            cpu::find_matter<Bytes>(rows[k >> 1][k & 1], size.x, found);
        }
        if (!cpu::any_in(found.moves, 0, size.x) || !cpu::any_in(found.room, 0, size.x)) continue;
        for (int x = -plane.offset_vox.x; x < size.x; x += 2) {
            const int from = std::max(x, 0);
            const int last = std::min(x + 1, size.x - 1);
            const int moves = found.moves[from] | found.moves[last];
            const int room = found.room[from] | found.room[last];
            if (moves != 0 && room != 0) run_block(rows, size.x, {x, y, plane.z}, plane.rule);
        }
    }
}

void run_plain(const Plane& plane) {
    run_plane<cpu::Bytes16>(plane);
}
#if defined(__x86_64__)
__attribute__((target("avx2"))) void run_avx2(const Plane& plane) {
    run_plane<cpu::Bytes32>(plane);
}
#endif

}  // namespace

void cpu_block_tick(Cells& cells, std::uint32_t tick, const CpuStep& step) {
    const glm::ivec3 size = cells.size_vox();
    CHECK(size.x <= world_side_max_vox && has_vectors(step.vectors));
    auto* run = run_plain;
#if defined(__x86_64__)
    if (step.vectors == CpuVectors::Avx2) run = run_avx2;
#endif
    const glm::ivec3 offset = block_offset_vox(step.seed, tick, glm::ivec3(2));
    cpu::for_each((size.z + offset.z + 1) / 2, step.threads, [&](int i) {
        run({.bytes = cells.bytes().data(),
             .size_vox = size,
             .offset_vox = offset,
             .z = 2 * i - offset.z,
             .rule = {step.seed, hash2(step.seed, tick), step.film_threshold}});
    });
}

}  // namespace tarn
