#include "reference/water_level.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "reference/water_lines.h"
#include "shared/hash.h"
#include "shared/water.h"
#include "world/schedule.h"

namespace tarn::reference {

namespace {

// The cells of one block, as what they hold; cells outside the world are closed.
class LevelBlock {
  public:
    LevelBlock(const Cells& cells, const PressureField* field, glm::ivec3 first, glm::ivec3 size)
        : first_(first), size_(size), has_field_(field != nullptr) {
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const glm::ivec3 cell = first + glm::ivec3(x, y, z);
                    content_.push_back(content_of(cells.get(cell, MATERIAL_WALL)));
                    head_.push_back(field != nullptr && cells.contains(cell) ? field->acting(cell) : 0);
                }
        content_before_ = content_;
        head_before_ = head_;
    }

    bool contains(glm::ivec3 p) const {
        return glm::all(glm::greaterThanEqual(p, glm::ivec3(0))) && glm::all(glm::lessThan(p, size_));
    }
    int& at(glm::ivec3 p) { return content_[index(p)]; }
    int at(glm::ivec3 p) const { return content_[index(p)]; }
    std::uint32_t& head(glm::ivec3 p) { return head_[index(p)]; }
    std::uint32_t head(glm::ivec3 p) const { return head_[index(p)]; }
    bool pressed(glm::ivec3 p) const { return is_pressed(head(p), first_.y + p.y); }
    int layer(glm::ivec3 p) const { return first_.y + p.y; }
    glm::ivec3 size() const { return size_; }
    bool on_floor() const { return first_.y == 0; }
    bool has_field() const { return has_field_; }
    bool nothing_moves() const {
        return std::none_of(content_.begin(), content_.end(),
                            [](int c) { return c != 0 && c != content_closed; });
    }

    void write(Cells& cells, PressureField* field, Activity& activity) const {
        std::size_t i = 0;
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x, ++i) {
                    const glm::ivec3 cell = first_ + glm::ivec3(x, y, z);
                    if (content_[i] != content_before_[i]) {
                        cells.at(cell) = byte_of_content(content_[i]);
                        activity.changed(cell);
                    }
                    if (head_[i] != head_before_[i]) field->set_acting(cell, head_[i]);
                }
    }

  private:
    std::size_t index(glm::ivec3 p) const {
        return p.x + std::size_t{1} * size_.x * (p.y + std::size_t{1} * size_.y * p.z);
    }

    glm::ivec3 first_, size_;
    bool has_field_;
    std::vector<int> content_, content_before_;
    std::vector<std::uint32_t> head_, head_before_;
};

constexpr glm::ivec3 up{0, 1, 0};

// Height in quarter voxels of the water in a cell of layer y.
int head_of_surface(int y, int content) {
    return y * head_per_voxel + content * head_per_voxel / full;
}

// One cell of a column: sand sinks, water falls, unless the head below holds it.
void fall(LevelBlock& block, glm::ivec3 upper, bool sinks_in_water) {
    int& u = block.at(upper);
    int& l = block.at(upper - up);
    if (!is_open(l)) return;
    if (u == content_sand) {
        if (l == 0 || sinks_in_water) std::swap(u, l);
    } else if (is_open(u) && u > 0 && l < full) {
        const std::uint32_t head = block.head(upper - up);
        const bool held = is_confined(head) && 2 * l >= full &&
                          height_of(head) >= head_of_surface(block.layer(upper), u) + head_per_voxel;
        if (held) return;
        const int falling = std::min(u, full - l);
        u -= falling;
        l += falling;
    }
}

void columns(LevelBlock& block) {
    for (int sweep = 0; sweep < 2; ++sweep)
        for (int z = 0; z < block.size().z; ++z)
            for (int x = 0; x < block.size().x; ++x)
                for (int y = 1; y < block.size().y; ++y) fall(block, {x, y, z}, sweep == 0);
}

// Sand that rests slides to the bottom of a neighbouring column, in sub-blocks of 2x2x2.
void slide_sand(LevelBlock& block, std::uint32_t chance) {
    const std::uint32_t sub = hash2(chance, 99);
    const glm::ivec3 start(sub & 1u, sub >> 1 & 1u, sub >> 2 & 1u);
    for (int z = start.z; z + 1 < block.size().z; z += 2)
        for (int y = start.y; y + 1 < block.size().y; y += 2)
            for (int x = start.x; x + 1 < block.size().x; x += 2) {
                const std::uint32_t way = hash4(sub, static_cast<std::uint32_t>(x),
                                                static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z));
                for (std::uint32_t k = 0; k < 4; ++k) {
                    const std::uint32_t i = (k + way) & 3u;
                    const auto column = [&](std::uint32_t c) {
                        return glm::ivec3(x + (c & 1u), y, z + (c >> 1));
                    };
                    int& sand = block.at(column(i) + up);
                    if (sand != content_sand || is_open(block.at(column(i)))) continue;
                    const bool z_first = (way >> (4 + k) & 1u) != 0;
                    for (const std::uint32_t step : {z_first ? 2u : 1u, z_first ? 1u : 2u}) {
                        const glm::ivec3 to = column(i ^ step);
                        if (!is_open(block.at(to)) || !is_open(block.at(to + up))) continue;
                        std::swap(sand, block.at(to));
                        break;
                    }
                }
            }
}

struct Support {
    bool stands = false, on_water = false;
};

// What water in each cell of a layer stands on. Of the block's lowest layer only the world's floor is known.
std::vector<Support> supports_of(const LevelBlock& block, int y) {
    std::vector<Support> supports;
    for (int z = 0; z < block.size().z; ++z)
        for (int x = 0; x < block.size().x; ++x) {
            if (y == 0) {
                supports.push_back({true, false});
                continue;
            }
            const glm::ivec3 below(x, y - 1, z);
            const int content = block.at(below);
            supports.push_back(
                {!is_open(content) || content == full || block.pressed(below), is_open(content)});
        }
    return supports;
}

// The line of cells from `start` on, `step` apart, while inside the block. `side`: steps to the two cells
// that a diagonal passes between, zero along an axis.
void level_along(LevelBlock& block, const std::vector<Support>& supports, glm::ivec3 start, glm::ivec3 step,
                 const LineRule& rule, std::uint32_t chance) {
    std::vector<glm::ivec3> cells;
    for (glm::ivec3 p = start; block.contains(p); p += step) cells.push_back(p);
    const bool diagonal = step.x != 0 && step.z != 0;
    if ((chance & 1u) != 0) {
        std::reverse(cells.begin(), cells.end());
        step = -step;
    }
    std::vector<LineCell> line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const glm::ivec3 p = cells[i];
        const Support support = supports[p.x + std::size_t{1} * block.size().x * p.z];
        const bool cut = diagonal && i + 1 < cells.size() &&
                         !is_open(block.at(p + glm::ivec3(step.x, 0, 0))) &&
                         !is_open(block.at(p + glm::ivec3(0, 0, step.z)));
        line.push_back({block.at(p), support.stands, support.on_water, block.pressed(p), cut});
    }
    if (!level_line(line, rule, chance)) return;
    for (std::size_t i = 0; i < cells.size(); ++i) block.at(cells[i]) = line[i].content;
}

std::uint32_t line_chance(std::uint32_t chance, int kind, int y, int line) {
    return hash2(chance, static_cast<std::uint32_t>(kind << 16 | y << 8 | line));
}

std::vector<std::vector<Support>> supports_of_layers(const LevelBlock& block, int lowest) {
    std::vector<std::vector<Support>> layers(block.size().y);
    for (int y = lowest; y < block.size().y; ++y) layers[y] = supports_of(block, y);
    return layers;
}

// Lines along x and z, in an order by hash; what water stands on is looked at anew between them.
void level_axes(LevelBlock& block, int lowest, int film_threshold, int least, std::uint32_t chance) {
    for (int pass = 0; pass < 2; ++pass) {
        const bool along_x = (chance >> 30 & 1u) == static_cast<std::uint32_t>(pass);
        const auto supports = supports_of_layers(block, lowest);
        const int lines = along_x ? block.size().z : block.size().x;
        for (int y = lowest; y < block.size().y; ++y)
            for (int i = 0; i < lines; ++i)
                level_along(block, supports[y], along_x ? glm::ivec3(0, y, i) : glm::ivec3(i, y, 0),
                            along_x ? glm::ivec3(1, 0, 0) : glm::ivec3(0, 0, 1),
                            {.film = film_threshold, .least = least, .rest_difference = 1},
                            line_chance(chance, along_x ? 0 : 1, y, i));
    }
}

void level_diagonals(LevelBlock& block, int lowest, int film_threshold, std::uint32_t chance) {
    const int side = block.size().x;
    for (int pass = 0; pass < 2; ++pass) {
        const bool rising = (chance >> 29 & 1u) == static_cast<std::uint32_t>(pass);
        const auto supports = supports_of_layers(block, lowest);
        // Lines start on the side z = 0, then on the side where x does not change.
        for (int y = lowest; y < block.size().y; ++y)
            for (int i = 0; i < 2 * side - 1; ++i) {
                const int along = std::min(i, side - 1);
                const glm::ivec3 start(rising ? side - 1 - along : along, y, std::max(0, i - side + 1));
                level_along(block, supports[y], start, {rising ? 1 : -1, 0, 1},
                            {.film = film_threshold, .least = 0, .rest_difference = 2},
                            line_chance(chance, rising ? 2 : 3, y, i));
            }
    }
}

// Confined water flows from the cell with more head, which keeps half.
void press_sideways(LevelBlock& block, glm::ivec3 from, glm::ivec3 to) {
    int& giving = block.at(from);
    int& taking = block.at(to);
    if (!is_open(giving) || !is_open(taking) || !block.pressed(to)) return;
    if (block.head(from) <= block.head(to)) return;
    const int moved = std::min(std::max(0, giving - full / 2), full - taking);
    giving -= moved;
    taking += moved;
}

void press_up(LevelBlock& block, glm::ivec3 lower, std::uint32_t chance) {
    const glm::ivec3 upper = lower + up;
    int& giving = block.at(lower);
    int& taking = block.at(upper);
    const std::uint32_t head = block.head(lower);
    if (!is_open(giving) || !is_open(taking) || !is_confined(head) || taking == full || giving == 0) return;
    const int height = head_of_surface(block.layer(upper), taking);
    if (height_of(head) < height + head_per_voxel) return;
    if (block.head(upper) > head) return;  // water comes from above
    const glm::ivec3 above = upper + up;
    if (!block.contains(above)) return;
    int moved = std::min(std::max(0, giving - full / 2), full - taking);
    if (block.at(above) == 0) {
        if (giving < full) return;
        const std::uint32_t random =
            hash3(chance, static_cast<std::uint32_t>(upper.x | upper.y << 8 | upper.z << 16), 0) & 0xffffu;
        const std::uint32_t quanta_65536 = static_cast<std::uint32_t>(height_of(head) - height) *
                                           (full * 65536u / (head_per_voxel * HEAD_RISE_TICKS));
        moved = std::min(moved, static_cast<int>((quanta_65536 + random) >> 16));
    }
    if (moved == 0) return;
    if (block.head(upper) == 0) block.head(upper) = head - head_step;
    giving -= moved;
    taking += moved;
}

// Water above that is nearer to the source flows down, whatever holds it.
void press_down(LevelBlock& block, glm::ivec3 upper) {
    const glm::ivec3 lower = upper - up;
    int& giving = block.at(upper);
    int& taking = block.at(lower);
    if (!is_open(giving) || !is_open(taking) || !is_confined(block.head(lower))) return;
    if (block.head(upper) <= block.head(lower)) return;
    const int moved = std::min(giving, full - taking);
    giving -= moved;
    taking += moved;
}

// From the far end of each line towards the source, so that room travels the whole line.
void press(LevelBlock& block, std::uint32_t chance) {
    const glm::ivec3 size = block.size();
    const int first = static_cast<int>(chance >> 5 & 0xffu) % 3;
    for (int pass = 0; pass < 3; ++pass) {
        const int axis = (first + pass) % 3;
        if (axis == 1) {
            for (int z = 0; z < size.z; ++z)
                for (int x = 0; x < size.x; ++x) {
                    for (int y = size.y - 2; y >= 0; --y) press_up(block, {x, y, z}, chance);
                    for (int y = 1; y < size.y; ++y) press_down(block, {x, y, z});
                }
            continue;
        }
        const int other = 2 - axis;
        for (int y = 0; y < size.y; ++y)
            for (int j = 0; j < size[other]; ++j) {
                glm::ivec3 p(0, y, 0);
                p[other] = j;
                glm::ivec3 step(0);
                step[axis] = 1;
                for (p[axis] = 0; p[axis] + 1 < size[axis]; p[axis] += 1) press_sideways(block, p + step, p);
                for (p[axis] = size[axis] - 1; p[axis] > 0; p[axis] -= 1) press_sideways(block, p - step, p);
            }
    }
}

std::uint32_t block_chance(std::uint32_t seed, std::uint32_t tick, glm::ivec3 block) {
    return hash4(seed, tick, static_cast<std::uint32_t>(block.x | block.z << 16),
                 static_cast<std::uint32_t>(block.y));
}

template <typename Act>
void for_blocks(const Cells& cells, glm::ivec3 block_vox, std::uint32_t seed, std::uint32_t tick,
                const Activity& activity, const Act& act) {
    const glm::ivec3 offset = block_offset_vox(seed, tick, block_vox);
    const glm::ivec3 count = (cells.size_vox() + offset + block_vox - 1) / block_vox;
    for (int z = 0; z < count.z; ++z)
        for (int y = 0; y < count.y; ++y)
            for (int x = 0; x < count.x; ++x) {
                const glm::ivec3 first = glm::ivec3(x, y, z) * block_vox - offset;
                if (activity.runs(first, block_vox)) act(first, block_chance(seed, tick, {x, y, z}));
            }
}

}  // namespace

void water_level_tick(Cells& cells, std::uint32_t seed, std::uint32_t tick, int film_threshold,
                      Activity& activity, PressureField* field) {
    const bool diagonal = hash2(seed ^ SALT_DIAGONAL, tick) % 3 == 0;
    const glm::ivec3 tall(TALL_SIDE, TALL_HEIGHT, TALL_SIDE);
    for_blocks(cells, tall, seed, tick, activity, [&](glm::ivec3 first, std::uint32_t chance) {
        LevelBlock block(cells, field, first, tall);
        if (block.nothing_moves()) return;
        columns(block);
        slide_sand(block, chance);
        const int lowest = block.on_floor() ? 0 : 1;
        if (diagonal)
            level_diagonals(block, lowest, film_threshold, chance);
        else
            level_axes(block, lowest, film_threshold, 0, chance);
        if (block.has_field()) press(block, chance);
        block.write(cells, field, activity);
    });
    const glm::ivec3 wide(WIDE_SIDE, WIDE_HEIGHT, WIDE_SIDE);
    for_blocks(cells, wide, seed ^ SALT_WIDE, tick, activity, [&](glm::ivec3 first, std::uint32_t chance) {
        LevelBlock block(cells, field, first, wide);
        if (block.nothing_moves()) return;
        level_axes(block, 1, film_threshold, WIDE_LEAST_QUANTA, chance);
        block.write(cells, field, activity);
    });
}

}  // namespace tarn::reference
