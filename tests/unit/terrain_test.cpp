#include "world/terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "world/noise.h"

namespace tarn {
namespace {

int height_at(const Cells& cells, int x, int z) {
    int y = cells.size_vox().y;
    while (y > 0 && cells.at({x, y - 1, z}) == MATERIAL_AIR) --y;
    return y;
}

TEST(Noise, IsPerlins2002NoiseInItsKnownProperties) {
    const PerlinNoise noise(1);
    double least = 1;
    double greatest = -1;
    double sum = 0;
    constexpr int n = 60;
    for (int i = 0; i < n * n * n; ++i) {
        const glm::dvec3 p = glm::dvec3(i % n, i / n % n, i / n / n) * 0.317;
        const double value = noise.at(p);
        least = std::min(least, value);
        greatest = std::max(greatest, value);
        sum += value;
        // Continuous: the gradient's length is bounded.
        EXPECT_LT(std::abs(noise.at(p + glm::dvec3(1e-4, -1e-4, 1e-4)) - value), 1e-3);
    }
    EXPECT_GE(least, -1);
    EXPECT_LE(greatest, 1);
    EXPECT_LT(least, -0.6);
    EXPECT_GT(greatest, 0.6);
    EXPECT_NEAR(sum / (n * n * n), 0, 0.02);
    for (const glm::dvec3 whole : {glm::dvec3(0), glm::dvec3(3, -7, 255), glm::dvec3(-256, 1000, 12)})
        EXPECT_EQ(noise.at(whole), 0);
    const glm::dvec3 p(0.3, -0.7, 5.1);
    EXPECT_NEAR(noise.at(p), noise.at(p + glm::dvec3(256, -512, 0)), 1e-9) << "period 256, also below zero";
}

TEST(Noise, SeedsGiveOtherFields) {
    const glm::dvec3 p(1.3, 2.7, 3.1);
    EXPECT_EQ(PerlinNoise(5).at(p), PerlinNoise(5).at(p));
    EXPECT_NE(PerlinNoise(5).at(p), PerlinNoise(6).at(p));
}

TEST(Noise, FractalStaysInRangeAndMoreOctavesAreRougher) {
    const PerlinNoise noise(2);
    const auto roughness = [&noise](int octaves) {
        double sum = 0;
        for (int i = 0; i < 2000; ++i) {
            const double a = noise.fractal({i * 0.11, 0.4, 0.2}, octaves, 0.6, 0);
            const double b = noise.fractal({i * 0.11 + 0.02, 0.4, 0.2}, octaves, 0.6, 0);
            EXPECT_LE(std::abs(a), 1);
            sum += std::abs(a - b);
        }
        return sum;
    };
    EXPECT_GT(roughness(6), 1.5 * roughness(1));
    for (int i = 0; i < 2000; ++i) EXPECT_LE(std::abs(noise.fractal({i * 0.13, 0.1, 0.7}, 4, 0.5, 1)), 1);
}

TEST(Terrain, SameSeedSameGroundOtherSeedOrSaltAnother) {
    const auto ground = [](std::uint32_t seed, int salt) {
        Cells cells({40, 32, 23});
        Terrain terrain;
        terrain.salt = salt;
        build_terrain(terrain, seed, cells);
        return cells;
    };
    EXPECT_EQ(ground(1, 0), ground(1, 0));
    EXPECT_NE(ground(1, 0), ground(2, 0));
    EXPECT_NE(ground(1, 0), ground(1, 1));
}

TEST(Terrain, LayersTopUnderRockAndLeavesWhatLiesAbove) {
    Cells cells({16, 24, 16});
    std::fill(cells.bytes().begin(), cells.bytes().end(), static_cast<std::uint8_t>(MATERIAL_WATER_FULL));
    Terrain terrain;
    terrain.base_height_vox = 12;
    terrain.amplitude_vox = 0;
    terrain.under_depth_vox = 4;
    build_terrain(terrain, 1, cells);
    for (int y = 0; y < 24; ++y) {
        const std::uint8_t expected = y >= 12   ? static_cast<std::uint8_t>(MATERIAL_WATER_FULL)
                                      : y == 11 ? MATERIAL_GRASS
                                      : y >= 7  ? MATERIAL_DIRT
                                                : MATERIAL_STONE;
        EXPECT_EQ(cells.at({5, y, 9}), expected) << y;
    }
}

TEST(Terrain, AShapePullsTheGroundToItsHeight) {
    Cells cells({64, 40, 64});
    Terrain terrain;
    terrain.base_height_vox = 20;
    terrain.amplitude_vox = 6;
    terrain.shapes.push_back({{32, 32}, {20, 10}, 5, 0.5, 1});
    build_terrain(terrain, 3, cells);
    EXPECT_EQ(height_at(cells, 32, 32), 5);
    EXPECT_EQ(height_at(cells, 40, 32), 5) << "the core, along x";
    EXPECT_GT(height_at(cells, 32, 44), 12) << "outside the shorter radius";
    EXPECT_GT(height_at(cells, 2, 2), 12);
}

TEST(Terrain, SandOfABeachLiesAtRest) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        Cells cells({48, 48, 48});
        Terrain terrain;
        terrain.base_height_vox = 20;
        terrain.amplitude_vox = 40;  // steep
        terrain.wavelength_vox = 24;
        terrain.beach = TerrainBeach{.height_vox = 24};
        build_terrain(terrain, seed, cells);
        int sand = 0;
        for (int z = 0; z < 48; ++z) {
            for (int x = 0; x < 48; ++x) {
                const int height = height_at(cells, x, z);
                if (cells.at({x, height - 1, z}) != MATERIAL_SAND) continue;
                ++sand;
                for (int d = 0; d < 9; ++d) {
                    const glm::ivec2 at(x + d % 3 - 1, z + d / 3 - 1);
                    if (at.x < 0 || at.y < 0 || at.x >= 48 || at.y >= 48) continue;
                    EXPECT_LE(height - height_at(cells, at.x, at.y), 1) << seed << ": " << x << " " << z;
                }
            }
        }
        EXPECT_GT(sand, 100) << seed;
    }
}

TEST(Terrain, RockLiesBareWhereItIsSteepOrHigh) {
    Cells cells({48, 64, 48});
    Terrain terrain;
    terrain.base_height_vox = 30;
    terrain.amplitude_vox = 60;
    terrain.wavelength_vox = 30;
    terrain.bare_height_vox = 40;
    build_terrain(terrain, 1, cells);
    int high = 0;
    for (int z = 0; z < 48; ++z) {
        for (int x = 0; x < 48; ++x) {
            const int height = height_at(cells, x, z);
            if (height <= 43) continue;
            ++high;
            EXPECT_EQ(cells.at({x, height - 1, z}), MATERIAL_STONE);
        }
    }
    EXPECT_GT(high, 50);
}

TEST(Terrain, HoldsInWorldsOfOneVoxelAndOfExtremeHeights) {
    Cells one({1, 1, 1});
    build_terrain({}, 1, one);
    EXPECT_NE(one.at({0, 0, 0}), MATERIAL_AIR);
    Cells thin({5, 8, 1});
    Terrain terrain;
    terrain.base_height_vox = 1e5;
    terrain.amplitude_vox = 1e5;
    terrain.wavelength_vox = 1;
    build_terrain(terrain, 1, thin);
    EXPECT_EQ(height_at(thin, 2, 0), 8) << "clipped at the world's top";
    terrain.base_height_vox = -1e5;
    terrain.amplitude_vox = 0;
    Cells low({5, 8, 3});
    build_terrain(terrain, 1, low);
    EXPECT_EQ(height_at(low, 2, 1), 1) << "a floor is always left";
}

}  // namespace
}  // namespace tarn
