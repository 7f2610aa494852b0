// Levelling of one line of cells: what the level and pressure tiers do along x, z and the diagonals.
#pragma once
#include <cstdint>
#include <span>

#include "shared/materials.h"

namespace tarn::reference {

constexpr int full = static_cast<int>(QUANTA_PER_VOXEL);

// What a cell holds: 0 to `full` quanta of water (0: air), or one of
constexpr int content_sand = 32;
constexpr int content_closed = 64;

int content_of(std::uint8_t byte);
std::uint8_t byte_of_content(int content);
constexpr bool is_open(int content) {
    return content <= 16;
}

struct LineCell {
    int content = content_closed;
    bool stands = false;    // something holds what is in it: solid, sand, or full water
    bool on_water = false;  // and that is water
    bool pressed = false;   // by the head of confined water
    bool cut = false;       // no way to the next cell
};

struct LineRule {
    int film = 3;             // quanta a cell that stay on dry ground
    int least = 0;            // quanta a cell below which water over dry ground is left alone
    int rest_difference = 1;  // largest minus smallest, in quanta, that counts as level
};

// Levels every run of open cells that stand; water at the end of a run falls into an open cell that does not
// stand. `chance` says who gets the remainders. Returns whether anything changed.
bool level_line(std::span<LineCell> line, const LineRule& rule, std::uint32_t chance);

}  // namespace tarn::reference
