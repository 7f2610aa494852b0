#include "reference/water_block.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "reference/water_lines.h"
#include "shared/hash.h"
#include "shared/water.h"
#include "world/schedule.h"

namespace tarn::reference {

namespace {

bool is_fluid(std::uint8_t byte) {
    return byte == MATERIAL_AIR || is_water(byte);
}

int quanta(std::uint8_t byte) {
    return static_cast<int>(quanta_of(byte));
}

std::uint8_t byte_of_quanta(int q) {
    return static_cast<std::uint8_t>(water_cell(static_cast<std::uint32_t>(q)));
}

struct Column {
    int a, b;  // 0 or 1 along the frame's two horizontal axes
};

// A block of 2x2x2 cells seen in its frame; `layer` 0 is the lower one.
class Block {
  public:
    Block(Cells& cells, glm::ivec3 first, std::uint32_t frame)
        : cells_(cells),
          first_(first),
          mirror_x_((frame & 1u) != 0),
          mirror_z_((frame & 2u) != 0),
          transposed_((frame & 4u) != 0) {}

    std::uint8_t get(Column c, int layer) const { return cells_.get(place(c, layer), MATERIAL_WALL); }
    void set(Column c, int layer, std::uint8_t byte) { cells_.at(place(c, layer)) = byte; }
    bool on_floor() const { return first_.y == 0; }
    // Whether sand may slide along the diagonal through `c`: true of half of all places, whatever the tick.
    bool diagonal_allowed(std::uint32_t seed, Column c) const {
        const glm::ivec3 at = place(c, 0) - first_;
        const std::uint32_t ways =
            hash3(seed, static_cast<std::uint32_t>(first_.x + 1), static_cast<std::uint32_t>(first_.z + 1));
        return (ways & (at.x == at.z ? 1u : 2u)) != 0;
    }

  private:
    glm::ivec3 place(Column c, int layer) const {
        int x = transposed_ ? c.b : c.a;
        int z = transposed_ ? c.a : c.b;
        if (mirror_x_) x = 1 - x;
        if (mirror_z_) z = 1 - z;
        return first_ + glm::ivec3(x, layer, z);
    }

    Cells& cells_;
    glm::ivec3 first_;
    bool mirror_x_, mirror_z_, transposed_;
};

// Calls act(column, its neighbour) for the block's four pairs: first those along a, then those along b.
template <typename Act>
void for_pairs(const Act& act) {
    for (int b = 0; b < 2; ++b) act(Column{0, b}, Column{1, b});
    for (int a = 0; a < 2; ++a) act(Column{a, 0}, Column{a, 1});
}

void fall(Block& block, Column c) {
    const std::uint8_t upper = block.get(c, 1);
    const std::uint8_t lower = block.get(c, 0);
    if (upper == MATERIAL_SAND && is_fluid(lower)) {
        block.set(c, 0, upper);
        block.set(c, 1, lower);
    } else if (is_water(upper) && is_fluid(lower)) {
        const int falling = std::min(quanta(upper), full - quanta(lower));
        block.set(c, 1, byte_of_quanta(quanta(upper) - falling));
        block.set(c, 0, byte_of_quanta(quanta(lower) + falling));
    }
}

// Sand on top of `from` slides to the bottom of `to`.
void slide(Block& block, Column from, Column to) {
    const bool rests = block.get(from, 1) == MATERIAL_SAND && !is_fluid(block.get(from, 0));
    if (!rests || !is_fluid(block.get(to, 1)) || !is_fluid(block.get(to, 0))) return;
    block.set(from, 1, block.get(to, 0));
    block.set(to, 0, MATERIAL_SAND);
}

// Whether water in `layer` of the column can stand; only the world's floor is known below layer 0.
bool is_supported(const Block& block, Column c, int layer) {
    if (layer == 0) return block.on_floor();
    const std::uint8_t below = block.get(c, 0);
    return !is_fluid(below) || quanta(below) == full;
}

void level(Block& block, int layer, Column first, Column second, int film_threshold) {
    const std::uint8_t one = block.get(first, layer);
    const std::uint8_t other = block.get(second, layer);
    if (!is_fluid(one) || !is_fluid(other)) return;
    const bool one_stands = is_supported(block, first, layer);
    const bool other_stands = is_supported(block, second, layer);
    const int total = quanta(one) + quanta(other);
    int share = 0;  // of the first
    if (one_stands && other_stands) {
        const bool at_rest = std::abs(quanta(one) - quanta(other)) <= 1;
        const bool film = (quanta(one) == 0 || quanta(other) == 0) && total < 2 * film_threshold;
        if (at_rest || film) return;
        share = total / 2;
    } else if (one_stands) {
        share = std::max(0, total - full);
    } else if (other_stands) {
        share = std::min(total, full);
    } else {
        return;
    }
    block.set(first, layer, byte_of_quanta(share));
    block.set(second, layer, byte_of_quanta(total - share));
}

void slide_diagonally(Block& block, Column c, std::uint32_t seed) {
    const Column opposite{1 - c.a, 1 - c.b};
    const bool passable =
        is_fluid(block.get({c.a, opposite.b}, 1)) || is_fluid(block.get({opposite.a, c.b}, 1));
    if (!passable || !block.diagonal_allowed(seed, c)) return;
    slide(block, c, opposite);
    slide(block, opposite, c);
}

// Levels a layer's four cells together, if all are open, stand, and have enough to go round. Returns whether
// they are done with.
bool level_square(Block& block, int layer, int film_threshold) {
    constexpr Column columns[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    int total = 0;
    int most = 0;
    int least = full;
    for (const Column c : columns) {
        if (!is_fluid(block.get(c, layer)) || !is_supported(block, c, layer)) return false;
        const int held = quanta(block.get(c, layer));
        total += held;
        most = std::max(most, held);
        least = std::min(least, held);
    }
    if (most - least <= 1) return true;
    if (least == 0 && total < 4 * film_threshold) return false;
    int rest = total % 4;
    for (const Column c : columns) block.set(c, layer, byte_of_quanta(total / 4 + (rest-- > 0 ? 1 : 0)));
    return true;
}

void step(Block block, std::uint32_t seed, int film_threshold, bool squares) {
    for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a) fall(block, {a, b});
    for_pairs([&](Column c, Column d) {
        slide(block, c, d);
        slide(block, d, c);
    });
    slide_diagonally(block, {0, 0}, seed);
    slide_diagonally(block, {1, 0}, seed);
    for (int layer = block.on_floor() ? 0 : 1; layer < 2; ++layer) {
        if (squares && level_square(block, layer, film_threshold)) continue;
        for_pairs([&](Column c, Column d) { level(block, layer, c, d, film_threshold); });
    }
}

glm::ivec3 corner(int k) {
    return {k & 1, k >> 1 & 1, k >> 2};
}

std::array<std::uint8_t, 8> bytes_of_block(const Cells& cells, glm::ivec3 first) {
    std::array<std::uint8_t, 8> bytes{};
    for (int k = 0; k < 8; ++k) bytes[k] = cells.get(first + corner(k), MATERIAL_WALL);
    return bytes;
}

}  // namespace

void water_block_tick(Cells& cells, std::uint32_t seed, std::uint32_t tick, int film_threshold,
                      Activity& activity) {
    const glm::ivec3 size = cells.size_vox();
    const glm::ivec3 offset = block_offset_vox(seed, tick, glm::ivec3(2));
    const std::uint32_t tick_key = hash2(seed, tick);
    const auto tile_of = [&](glm::ivec3 block) {
        return (block + offset) / BLOCK_TILE * BLOCK_TILE - offset;
    };
    for (int z = -offset.z; z < size.z; z += 2)
        for (int y = -offset.y; y < size.y; y += 2)
            for (int x = -offset.x; x < size.x; x += 2) {
                const glm::ivec3 first(x, y, z);
                if (!activity.runs(tile_of(first), glm::ivec3(BLOCK_TILE))) continue;
                const std::uint32_t xz = static_cast<std::uint32_t>(x + 1) | static_cast<std::uint32_t>(z + 1)
                                                                                 << 16;
                const std::uint32_t chance = hash3(tick_key, xz, static_cast<std::uint32_t>(y + 1));
                const auto before = bytes_of_block(cells, first);
                step(Block(cells, first, chance & 7u), seed, film_threshold, (chance >> 3) % 4 == 0);
                const auto after = bytes_of_block(cells, first);
                for (int k = 0; k < 8; ++k)
                    if (before[k] != after[k]) activity.changed(first + corner(k));
            }
}

}  // namespace tarn::reference
