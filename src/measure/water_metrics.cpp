#include "measure/water_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/error.h"

namespace tarn {

namespace {

bool is_fluid(std::uint8_t byte) {
    return byte == MATERIAL_AIR || is_water(byte);
}

std::array<std::uint8_t, MATERIAL_COUNT> quanta_by_byte() {
    std::array<std::uint8_t, MATERIAL_COUNT> quanta{};
    for (std::uint32_t byte = 0; byte < MATERIAL_COUNT; ++byte)
        quanta[byte] = static_cast<std::uint8_t>(quanta_of(byte));
    return quanta;
}

double column_vox(const Cells& cells, int x, int z, int y_begin, int y_end) {
    std::uint32_t quanta = 0;
    for (int y = y_begin; y < y_end; ++y) quanta += quanta_of(cells.at({x, y, z}));
    return quanta / double{QUANTA_PER_VOXEL};
}

template <typename Act>
void for_columns(const Cells& cells, const Box& region, const Act& act) {
    for (int z = region.min_vox.z; z < region.max_vox.z; ++z)
        for (int x = region.min_vox.x; x < region.max_vox.x; ++x)
            act(x, z, column_vox(cells, x, z, region.min_vox.y, region.max_vox.y));
}

}  // namespace

Heights column_heights(const Cells& cells, const Box& region) {
    CHECK(region.volume() > 0);
    double sum = 0;
    double squares = 0;
    Heights heights{.lowest = std::numeric_limits<double>::infinity()};
    for_columns(cells, region, [&](int, int, double height) {
        sum += height;
        squares += height * height;
        heights.lowest = std::min(heights.lowest, height);
        heights.highest = std::max(heights.highest, height);
    });
    const double n = static_cast<double>(region.size().x) * region.size().z;
    heights.sd = std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)));
    return heights;
}

double mean_depth_vox(const Cells& cells, const Box& region) {
    CHECK(region.volume() > 0);
    double sum = 0;
    for_columns(cells, region, [&](int, int, double height) { sum += height; });
    return sum / (static_cast<double>(region.size().x) * region.size().z);
}

Spread spread_around(const Cells& cells, double x_vox, double z_vox) {
    Spread spread;
    double xx = 0, zz = 0, d1 = 0, d2 = 0, r4 = 0, r4_cos4 = 0, axis = 0, diagonal = 0;
    const double sector = std::cos(std::acos(-1.0) / 4);  // cos 4a at 11.25 degrees from an axis
    for_columns(cells, {glm::ivec3(0), cells.size_vox()}, [&](int cell_x, int cell_z, double amount) {
        if (amount == 0) return;
        const double x = cell_x + 0.5 - x_vox;
        const double z = cell_z + 0.5 - z_vox;
        const double r2 = x * x + z * z;
        const double cos4 = std::cos(4 * std::atan2(z, x));
        spread.volume_vox += amount;
        xx += amount * x * x;
        zz += amount * z * z;
        d1 += amount * (x + z) * (x + z) / 2;
        d2 += amount * (x - z) * (x - z) / 2;
        r4 += amount * r2 * r2;
        r4_cos4 += amount * r2 * r2 * cos4;
        if (cos4 > sector) axis = std::max(axis, std::sqrt(r2));
        if (cos4 < -sector) diagonal = std::max(diagonal, std::sqrt(r2));
    });
    spread.xx_over_zz = xx / zz;
    spread.d1_over_d2 = d1 / d2;
    spread.c4 = r4_cos4 / r4;
    spread.axis_over_diagonal = axis / diagonal;
    return spread;
}

SandPile sand_pile(const Cells& cells) {
    const glm::ivec3 size = cells.size_vox();
    SandPile pile;
    std::vector<int> tops(std::size_t{1} * size.x * size.z, 0);
    const auto top = [&](int x, int z) -> int& { return tops[x + std::size_t{1} * size.x * z]; };
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                if (cells.at({x, y, z}) != MATERIAL_SAND) continue;
                top(x, z) = y + 1;
                pile.peak_vox = std::max(pile.peak_vox, y + 1);
                if (y > 0 && is_fluid(cells.at({x, y - 1, z}))) ++pile.over_fluid;
            }
    for (int z = 0; z < size.z; ++z)
        for (int x = 0; x < size.x; ++x) {
            if (x + 1 < size.x && std::abs(top(x, z) - top(x + 1, z)) > 1) ++pile.steep_pairs;
            if (z + 1 < size.z && std::abs(top(x, z) - top(x, z + 1)) > 1) ++pile.steep_pairs;
        }
    return pile;
}

std::uint64_t hanging_water(const Cells& cells) {
    const glm::ivec3 size = cells.size_vox();
    std::uint64_t hanging = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 1; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                hanging += is_water(cells.at({x, y, z})) && cells.at({x, y - 1, z}) == MATERIAL_AIR;
    return hanging;
}

CellsDifference difference(const Cells& before, const Cells& after) {
    CHECK(before.size_vox() == after.size_vox());
    static const auto quanta = quanta_by_byte();
    CellsDifference result;
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < before.count(); ++i) {
        const std::uint8_t a = before.bytes()[i];
        const std::uint8_t b = after.bytes()[i];
        if (a == b) continue;
        ++result.changed_cells;
        sum += static_cast<std::uint64_t>(std::abs(quanta[a] - quanta[b]));
    }
    result.moved_quanta = sum / 2;
    return result;
}

Mass mass_of(const Cells& cells) {
    static const auto quanta = quanta_by_byte();
    Mass mass;
    for (const std::uint8_t byte : cells.bytes()) {
        mass.water_quanta += quanta[byte];
        mass.sand_voxels += byte == MATERIAL_SAND;
    }
    return mass;
}

}  // namespace tarn
