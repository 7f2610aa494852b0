#include "world/cells.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tarn {
namespace {

TEST(Cells, LieXFastestThenYThenZ) {
    Cells cells({3, 5, 7});
    EXPECT_EQ(cells.count(), 105u);
    EXPECT_EQ(cells.index({1, 0, 0}), 1u);
    EXPECT_EQ(cells.index({0, 1, 0}), 3u);
    EXPECT_EQ(cells.index({0, 0, 1}), 15u);
    EXPECT_EQ(cells.index({2, 4, 6}), 104u);
    cells.at({2, 4, 6}) = MATERIAL_SAND;
    EXPECT_EQ(cells.bytes().back(), MATERIAL_SAND);
}

TEST(Cells, OutsideIsWhatTheCallerSays) {
    const Cells cells({2, 2, 2});
    EXPECT_EQ(cells.get({1, 1, 1}, MATERIAL_WALL), MATERIAL_AIR);
    for (const glm::ivec3 outside : {glm::ivec3(-1, 0, 0), glm::ivec3(0, 2, 0), glm::ivec3(0, 0, 1 << 30)})
        EXPECT_EQ(cells.get(outside, MATERIAL_WALL), MATERIAL_WALL);
}

TEST(Cells, CensusCountsVoxelsByMaterialAndWaterByQuanta) {
    Cells cells({4, 4, 4});
    cells.at({0, 0, 0}) = MATERIAL_STONE;
    std::uint64_t quanta = 0;
    for (std::uint32_t q = 1; q <= 16; ++q) {
        cells.bytes()[10 + q] = static_cast<std::uint8_t>(water_cell(q));
        quanta += q;
    }
    cells.at({3, 3, 3}) = 80;  // the first byte above water holds none
    const Census census = take_census(cells);
    EXPECT_EQ(census.water_quanta, quanta);
    EXPECT_EQ(census.voxels[MATERIAL_WATER], 16u);
    EXPECT_EQ(census.voxels[MATERIAL_STONE], 1u);
    EXPECT_EQ(census.voxels[80], 1u);
    EXPECT_EQ(census.voxels[MATERIAL_AIR], 64u - 18u);
    for (int byte = 65; byte <= 79; ++byte) EXPECT_EQ(census.voxels[byte], 0u) << byte;
}

TEST(Cells, CensusOfTheLargestWorldNeeds64Bits) {
    // 1024 x 1024 x 257 full voxels hold 4,311,744,512 quanta, more than 32 bits count.
    Cells cells({1024, 257, 1024});
    std::fill(cells.bytes().begin(), cells.bytes().end(), static_cast<std::uint8_t>(MATERIAL_WATER_FULL));
    EXPECT_EQ(take_census(cells).water_quanta, 16u * 1024ull * 257ull * 1024ull);
    EXPECT_GT(take_census(cells).water_quanta, std::uint64_t{0xffffffffu});
}

TEST(Cells, HashTellsBytesPlacesAndSizesApart) {
    Cells a({2, 3, 4});
    EXPECT_EQ(hash_of(a), hash_of(Cells({2, 3, 4})));
    EXPECT_NE(hash_of(a), hash_of(Cells({3, 2, 4})));
    EXPECT_NE(hash_of(a), hash_of(Cells({4, 3, 2})));
    Cells b = a;
    b.at({0, 0, 0}) = 1;
    Cells c = a;
    c.at({1, 0, 0}) = 1;
    EXPECT_NE(hash_of(a), hash_of(b));
    EXPECT_NE(hash_of(b), hash_of(c));
    // FNV-1a of no bytes but twelve of size, computed apart (Python): pins the definition across versions.
    EXPECT_EQ(hash_of(Cells({0, 0, 0})), 0x5467b0da1d106495u);
    Cells one({1, 1, 1});
    one.at({0, 0, 0}) = MATERIAL_SAND;
    EXPECT_EQ(hash_of(one), 0x73602b582dbc1950u);
}

}  // namespace
}  // namespace tarn
