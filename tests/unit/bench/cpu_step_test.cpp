// The CPU's step that the benchmark measures against is the reference's, byte for byte.
#include "bench/cpu_step.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "gpu/worlds.h"
#include "reference/water_block.h"
#include "reference/water_level.h"

namespace tarn {
namespace {

using ReferenceTick = void (*)(Cells&, std::uint32_t seed, std::uint32_t tick, int film_threshold,
                               reference::Activity&);
using CpuTick = void (*)(Cells&, std::uint32_t tick, const CpuStep&);

void expect_same(ReferenceTick reference_tick, CpuTick cpu_tick) {
    for (const glm::ivec3 size :
         {glm::ivec3(1), glm::ivec3(7, 13, 5), glm::ivec3(61, 37, 45), glm::ivec3(150, 19, 33)})
        for (const Soup soup : {Soup::AllBytes, Soup::Matter, Soup::Water, Soup::Layers}) {
            const Cells start = make_soup(size, soup, 7);
            Cells expected = start;
            Cells plain = start;
            Cells avx2 = start;
            reference::Activity activity(size);
            activity.set_always_awake(true);
            CpuStep step{.seed = 11, .film_threshold = 4, .threads = 3};
            // Across the wrap of the tick; lines lie along axes and along diagonals.
            for (std::uint32_t tick = 0u - 4u; tick != 5; ++tick) {
                SCOPED_TRACE(fmt::format("soup {}, tick {}", static_cast<int>(soup), tick));
                reference_tick(expected, step.seed, tick, step.film_threshold, activity);
                step.vectors = CpuVectors::Plain;
                cpu_tick(plain, tick, step);
                ASSERT_TRUE(same_cells(plain, expected));
                step.vectors = CpuVectors::Avx2;
                if (!has_vectors(step.vectors)) continue;
                cpu_tick(avx2, tick, step);
                ASSERT_TRUE(same_cells(avx2, expected));
            }
            EXPECT_TRUE(size.x == 1 || expected != start);
        }
}

TEST(CpuStep, block_equals_the_reference) {
    expect_same(reference::water_block_tick, cpu_block_tick);
}

TEST(CpuStep, level_equals_the_reference) {
    expect_same(
        [](Cells& cells, std::uint32_t seed, std::uint32_t tick, int film_threshold,
           reference::Activity& activity) {
            reference::water_level_tick(cells, seed, tick, film_threshold, activity, nullptr);
        },
        cpu_level_tick);
}

}  // namespace
}  // namespace tarn
