// Block offsets and the spread of springs: data that the GPU and the references share.
#include "world/schedule.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <numeric>
#include <set>

namespace tarn {
namespace {

TEST(Schedule, each_run_uses_every_offset_once) {
    for (const int side : {1, 2, 8, 16, 32, 64})
        for (const std::uint32_t first : {0u, 64u * 77, 0u - 64u})
            for (int axis = 0; axis < 3; ++axis) {
                std::set<int> seen;
                for (int i = 0; i < side; ++i) {
                    const int offset = block_offset_vox(5, first + i, glm::ivec3(side))[axis];
                    EXPECT_TRUE(offset >= 0 && offset < side);
                    seen.insert(offset);
                }
                EXPECT_EQ(static_cast<int>(seen.size()), side);
            }
}

// A run of n ticks ends where 2^32 does, so that the next one, from tick 0, is whole too.
TEST(Schedule, axes_of_unlike_sides_keep_their_own_runs) {
    const glm::ivec3 sides(64, 2, 16);
    for (const std::uint32_t first : {0u, 0u - 64u}) {
        std::array<std::map<int, int>, 3> uses;
        for (int i = 0; i < 64; ++i) {
            const glm::ivec3 offset = block_offset_vox(9, first + i, sides);
            for (int axis = 0; axis < 3; ++axis) ++uses[axis][offset[axis]];
        }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(static_cast<int>(uses[axis].size()), sides[axis]);
            for (const auto& [offset, count] : uses[axis]) EXPECT_EQ(count, 64 / sides[axis]) << offset;
        }
    }
}

TEST(Schedule, axes_and_seeds_are_independent) {
    int together = 0;
    int seeds_agree = 0;
    constexpr int ticks = 4000;
    for (std::uint32_t tick = 0; tick < ticks; tick += 2) {
        const glm::ivec3 offset = block_offset_vox(1, tick, glm::ivec3(2));
        together += offset.x == offset.z ? 1 : 0;
        seeds_agree += offset == block_offset_vox(2, tick, glm::ivec3(2)) ? 1 : 0;
    }
    EXPECT_NEAR(together, ticks / 4.0, 150);
    EXPECT_NEAR(seeds_agree, ticks / 16.0, 80);
}

TEST(Schedule, spring_shares_add_up_exactly) {
    for (const std::uint64_t n : {1u, 2u, 3u, 7u, 64u, 1000u, 65535u, 65536u, 65537u, 300000u})
        for (const std::uint32_t per_tick : {1u, 5u, 63u, 65536u, 1000003u, 0x80000000u})
            for (const std::uint32_t tick : {0u, 9u, 0xffffffffu}) {
                const SpringShare s = spring_share(per_tick, n, 3, tick, 1);
                ASSERT_EQ(std::gcd(s.stride, s.n), 1u);
                std::uint64_t sum = 0;
                for (std::uint64_t i = 0; i < n; ++i)
                    sum += s.base + ((i * s.stride + s.phase) % s.n < s.rest ? 1u : 0u);
                ASSERT_EQ(sum, per_tick) << n << ' ' << tick;
            }
}

TEST(Schedule, spring_shares_stay_within_32_bits) {
    for (std::uint64_t n = 1; n <= (std::uint64_t{1} << 30); n = n * 3 / 2 + 1) {
        const SpringShare s = spring_share(0x80000000u, n, 3, 4, 5);
        EXPECT_LE((n - 1) * s.stride + s.phase, 0xffffffffu) << n;
        EXPECT_GE(s.stride, 1u);
    }
    const SpringShare s = spring_share(1, std::uint64_t{1} << 30, 3, 4, 5);
    EXPECT_EQ(std::gcd(s.stride, s.n), 1u);
}

TEST(Schedule, clipping_never_leaves_the_world) {
    const glm::ivec3 size(10, 20, 30);
    EXPECT_EQ(clipped({{-5, -5, -5}, {5, 50, 31}}, size), (Box{{0, 0, 0}, {5, 20, 30}}));
    EXPECT_EQ(clipped({{10, 0, 0}, {15, 5, 5}}, size).volume(), 0u);
    EXPECT_EQ(clipped({{5, 5, 5}, {2, 9, 9}}, size).volume(), 0u);
    EXPECT_EQ(clipped({{-9, -9, -9}, {-5, -5, -5}}, size).volume(), 0u);
}

}  // namespace
}  // namespace tarn
