// What rays skip by (glsl/shared/rooms.h), counted from the cells: rooms grow level by level, each covered by
// eight or fewer of the level below, so that nothing is shared with the sweeps of the shader.
#pragma once
#include <array>
#include <vector>

#include "shared/bindings.h"
#include "shared/rooms.h"
#include "world/cells.h"

namespace tarn {

class BrickRooms {
  public:
    explicit BrickRooms(const Cells& cells) : size_((cells.size_vox() + BRICK_SIDE - 1) / BRICK_SIDE) {
        for (const std::uint32_t medium : {std::uint32_t{MATERIAL_AIR}, MATERIAL_WATER_FULL})
            add_words(cells, medium);
    }
    glm::ivec3 size() const { return {size_.x, size_.y, 2 * size_.z}; }
    const std::vector<glm::uvec2>& words() const { return words_; }  // x fastest

  private:
    std::size_t flat(glm::ivec3 brick) const {
        return brick.x + std::size_t{1} * size_.x * (brick.y + std::size_t{1} * size_.y * brick.z);
    }
    template <typename Act>
    void for_bricks(const Act& act) const {
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x) act(glm::ivec3(x, y, z));
    }

    void add_words(const Cells& cells, std::uint32_t medium) {
        const bool air = medium == MATERIAL_AIR;
        const std::size_t first = words_.size();
        words_.resize(first + std::size_t{1} * size_.x * size_.y * size_.z);
        for_bricks([&](glm::ivec3 brick) {
            glm::uvec2 mask(0);
            for (int i = 0; i < 64; ++i) {
                const glm::ivec3 at(i & 3, i >> 2 & 3, i >> 4);
                if (cells.get(brick * BRICK_SIDE + at, MATERIAL_AIR) != medium)
                    mask[i / 32] |= 1u << (i % 32);
            }
            const bool clear = mask == glm::uvec2(0);
            words_[first + flat(brick)] =
                clear ? glm::uvec2(0, ROOM_CLEAR) : glm::uvec2(room_word_x(mask.x, mask.y), mask.y);
        });
        std::vector<char> alone(words_.size() - first);
        for (std::size_t i = 0; i < alone.size(); ++i)
            alone[i] = words_[first + i] == glm::uvec2(0, ROOM_CLEAR);
        for (int octant = 0; octant < 8; ++octant) {
            const glm::ivec3 ahead(octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1);
            std::vector<char> clear = alone;  // the room of the level
            std::vector<std::uint32_t> levels(clear.size(), 0);
            for (int level = 1; level < ROOM_LEVELS; ++level) {
                // How far apart two of the level below lie in it: they cover it.
                const int across = room_across(level) - room_across(level - 1);
                const int up = room_up(level) - room_up(level - 1);
                const glm::ivec3 apart(across, up, across);
                const std::vector<char> before = clear;
                for_bricks([&](glm::ivec3 brick) {
                    bool all = true;
                    for (int corner = 0; corner < 8; ++corner) {
                        const glm::ivec3 shift(corner & 1, corner >> 1 & 1, corner >> 2);
                        const glm::ivec3 other = brick + ahead * shift * apart;
                        const bool inside = glm::all(glm::greaterThanEqual(other, glm::ivec3(0))) &&
                                            glm::all(glm::lessThan(other, size_));
                        all = all && (inside ? before[flat(other)] != 0 : air);
                    }
                    clear[flat(brick)] = all ? 1 : 0;
                    if (all) levels[flat(brick)] = level;
                });
            }
            for (std::size_t i = 0; i < levels.size(); ++i)
                if (alone[i]) words_[first + i].x |= levels[i] << (3 * octant);
        }
    }

    glm::ivec3 size_;
    std::vector<glm::uvec2> words_;
};

}  // namespace tarn
