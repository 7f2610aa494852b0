#include "world/schedule.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/error.h"
#include "shared/hash.h"

namespace tarn {

namespace {

constexpr int block_side_max = 64;

int offset_along(std::uint32_t seed, std::uint32_t tick, std::uint32_t axis, int side) {
    CHECK(side >= 1 && side <= block_side_max && (side & (side - 1)) == 0);
    const auto n = static_cast<std::uint32_t>(side);
    std::array<int, block_side_max> order{};
    std::iota(order.begin(), order.begin() + side, 0);
    std::uint32_t state = hash3(seed, tick / n, axis);
    for (std::uint32_t i = n - 1; i > 0; --i) {
        state = hash1(state + i);
        std::swap(order[i], order[state % (i + 1)]);
    }
    return order[tick % n];
}

}  // namespace

glm::ivec3 block_offset_vox(std::uint32_t seed, std::uint32_t tick, glm::ivec3 block_vox) {
    return {offset_along(seed, tick, 0, block_vox.x), offset_along(seed, tick, 1, block_vox.y),
            offset_along(seed, tick, 2, block_vox.z)};
}

SpringShare spring_share(std::uint32_t per_tick, std::uint64_t n, std::uint32_t seed, std::uint32_t tick,
                         std::uint32_t index) {
    CHECK(n >= 1 && n <= (std::uint64_t{1} << 30));
    SpringShare share;
    share.n = static_cast<std::uint32_t>(n);
    share.base = per_tick / share.n;
    share.rest = per_tick % share.n;
    share.phase = hash3(seed ^ 0x5b6c1a37u, tick, index) % share.n;
    // Steps of about 0.618 n spread any number of cells evenly (Weyl); (n - 1) * stride + phase must fit.
    const std::uint64_t most = n > 1 ? 0xffffffffull / (n - 1) - 1 : 1;
    auto stride = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, n * 618 / 1000 + 1));
    while (std::gcd(stride, share.n) != 1) --stride;
    share.stride = stride;
    return share;
}

Box clipped(const Box& box, glm::ivec3 size_vox) {
    const glm::ivec3 low = glm::clamp(box.min_vox, glm::ivec3(0), size_vox);
    return {low, glm::max(low, glm::min(box.max_vox, size_vox))};
}

}  // namespace tarn
