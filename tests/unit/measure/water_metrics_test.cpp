// Figures of water on worlds made by hand, whose values follow from pencil and paper.
#include "measure/water_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tarn {
namespace {

std::uint8_t water(std::uint32_t quanta) {
    return static_cast<std::uint8_t>(water_cell(quanta));
}

TEST(WaterMetrics, HeightsOfKnownColumns) {
    // Columns of 1, 2, 3 and 4 voxels: mean 2.5, variance 1.25; partly filled cells count by their amount.
    Cells cells({4, 6, 1});
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y <= x; ++y) cells.at({x, y, 0}) = MATERIAL_WATER_FULL;
    cells.at({0, 0, 0}) = water(8);
    cells.at({0, 3, 0}) = water(8);  // in two pieces, air between them
    cells.at({3, 5, 0}) = MATERIAL_SAND;
    const Heights all = column_heights(cells, {{0, 0, 0}, {4, 6, 1}});
    EXPECT_DOUBLE_EQ(all.sd, std::sqrt(1.25));
    EXPECT_EQ(all.lowest, 1);
    EXPECT_EQ(all.highest, 4);
    const Heights part = column_heights(cells, {{1, 1, 0}, {3, 6, 1}});
    EXPECT_DOUBLE_EQ(part.sd, 0.5);
    EXPECT_EQ(part.lowest, 1);
    EXPECT_EQ(part.highest, 2);
    EXPECT_DOUBLE_EQ(mean_depth_vox(cells, {{0, 0, 0}, {4, 6, 1}}), 2.5);
    EXPECT_DOUBLE_EQ(mean_depth_vox(cells, {{2, 2, 0}, {4, 6, 1}}), 1.5);
    EXPECT_EQ(column_heights(Cells({3, 3, 3}), {{0, 0, 0}, {3, 3, 3}}).sd, 0);
}

// A disc reaches as far along the axes as between them, a square farther into its corners, a diamond farther
// along the axes.
TEST(WaterMetrics, TellADiscFromASquareAndADiamond) {
    const int side = 101;
    const auto shape = [&](auto inside) {
        Cells cells({side, 2, side});
        for (int z = 0; z < side; ++z)
            for (int x = 0; x < side; ++x)
                if (inside(x - side / 2, z - side / 2)) cells.at({x, 0, z}) = MATERIAL_WATER_FULL;
        return spread_around(cells, side / 2.0, side / 2.0);
    };
    const Spread disc = shape([](int x, int z) { return x * x + z * z <= 40 * 40; });
    EXPECT_NEAR(disc.axis_over_diagonal, 1, 0.02);
    EXPECT_NEAR(disc.c4, 0, 0.015);  // its rim is one of voxels
    EXPECT_DOUBLE_EQ(disc.xx_over_zz, 1);
    EXPECT_NEAR(disc.volume_vox, std::acos(-1.0) * 40 * 40, 60);

    const Spread square = shape([](int x, int z) { return std::abs(x) <= 40 && std::abs(z) <= 40; });
    // The farthest within 11.25 degrees of an axis: (40, 7), just below 40 tan 11.25 = 7.96.
    EXPECT_DOUBLE_EQ(square.axis_over_diagonal, std::hypot(40, 7) / std::hypot(40, 40));
    // <r^4 cos 4a> / <r^4> of a square of half side h: (2/5 - 6/9) / (2/5 + 2/9) = -3/7.
    EXPECT_NEAR(square.c4, -3.0 / 7, 0.002);
    EXPECT_DOUBLE_EQ(square.d1_over_d2, 1);

    const Spread diamond = shape([](int x, int z) { return std::abs(x) + std::abs(z) <= 40; });
    EXPECT_GT(diamond.axis_over_diagonal, 1.25);
    EXPECT_NEAR(diamond.c4, 3.0 / 7, 0.01);

    const Spread rectangle = shape([](int x, int z) { return std::abs(x) <= 40 && std::abs(z) <= 20; });
    // Second moments of 81 and 41 cells in a row: n^2 - 1 each.
    EXPECT_NEAR(rectangle.xx_over_zz, (81.0 * 81 - 1) / (41.0 * 41 - 1), 1e-9);
    EXPECT_NEAR(rectangle.d1_over_d2, 1, 1e-12);
    const Spread slanted = shape([](int x, int z) { return std::abs(x - z) <= 4 && std::abs(x) <= 30; });
    EXPECT_GT(slanted.d1_over_d2, 10);
}

TEST(WaterMetrics, SandPilesSteepPairsAndSandOverFluid) {
    Cells cells({5, 8, 5});
    const auto column = [&](int x, int z, int height) {
        for (int y = 0; y < height; ++y) cells.at({x, y, z}) = MATERIAL_SAND;
    };
    column(2, 2, 2);
    for (const auto& [x, z] : {std::pair{1, 2}, {3, 2}, {2, 1}, {2, 3}}) column(x, z, 1);
    SandPile pile = sand_pile(cells);
    EXPECT_EQ(pile.peak_vox, 2);
    EXPECT_EQ(pile.steep_pairs, 0);
    EXPECT_EQ(pile.over_fluid, 0u);
    cells.at({2, 2, 2}) = MATERIAL_SAND;  // 3 beside 1: four pairs
    pile = sand_pile(cells);
    EXPECT_EQ(pile.peak_vox, 3);
    EXPECT_EQ(pile.steep_pairs, 4);
    cells.at({2, 1, 2}) = water(16);
    EXPECT_EQ(sand_pile(cells).over_fluid, 1u);
    cells.at({2, 1, 2}) = MATERIAL_AIR;
    EXPECT_EQ(sand_pile(cells).over_fluid, 1u);
    cells.at({2, 1, 2}) = MATERIAL_STONE;
    EXPECT_EQ(sand_pile(cells).over_fluid, 0u);
}

TEST(WaterMetrics, HangingWaterHasAirStraightBelow) {
    Cells cells({3, 4, 1});
    cells.at({0, 0, 0}) = water(1);
    cells.at({1, 1, 0}) = water(3);
    cells.at({1, 2, 0}) = water(16);
    cells.at({2, 2, 0}) = water(16);
    cells.at({2, 1, 0}) = MATERIAL_SAND;
    EXPECT_EQ(hanging_water(cells), 1u);
}

TEST(WaterMetrics, DifferencesCountCellsAndHalfTheQuanta) {
    Cells before({4, 1, 1});
    before.at({0, 0, 0}) = water(16);
    before.at({1, 0, 0}) = water(2);
    before.at({3, 0, 0}) = MATERIAL_SAND;
    EXPECT_EQ(difference(before, before).changed_cells, 0u);
    Cells after = before;
    after.at({0, 0, 0}) = water(6);
    after.at({1, 0, 0}) = water(5);
    after.at({2, 0, 0}) = water(7);
    EXPECT_EQ(difference(before, after).changed_cells, 3u);
    EXPECT_EQ(difference(before, after).moved_quanta, 10u);
    EXPECT_EQ(mass_of(before), (Mass{18, 1}));
    EXPECT_EQ(mass_of(after), (Mass{18, 1}));
    after.at({3, 0, 0}) = MATERIAL_WATER_FULL;
    EXPECT_EQ(mass_of(after), (Mass{34, 0}));
}

TEST(HeldSince, IsTheFirstTickOfTheLastUnbrokenRun) {
    HeldSince held;
    EXPECT_FALSE(held.since());
    EXPECT_EQ(held.ticks(), 0);
    const char* const looks = "..##.#..###";
    const int since[] = {-1, -1, 2, 2, -1, 5, -1, -1, 8, 8, 8};
    for (int tick = 0; looks[tick] != 0; ++tick) {
        held.look(tick, looks[tick] == '#');
        EXPECT_EQ(held.since().value_or(-1), since[tick]) << tick;
        EXPECT_EQ(held.ticks(), since[tick] < 0 ? 0 : tick - since[tick] + 1) << tick;
    }
}

}  // namespace
}  // namespace tarn
