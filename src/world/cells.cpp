#include "world/cells.h"

namespace tarn {

Census take_census(const Cells& cells) {
    std::array<std::uint64_t, MATERIAL_COUNT> by_byte{};
    for (const std::uint8_t byte : cells.bytes()) ++by_byte[byte];
    Census census;
    for (std::uint32_t byte = 0; byte < MATERIAL_COUNT; ++byte) {
        census.voxels[material_of(byte)] += by_byte[byte];
        census.water_quanta += by_byte[byte] * quanta_of(byte);
    }
    return census;
}

std::uint64_t hash_of(const Cells& cells) {
    // FNV-1a (Fowler, Noll, Vo), 64 bits; the size enters as three little-endian 32-bit words.
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&hash](std::uint8_t byte) { hash = (hash ^ byte) * 0x100000001b3u; };
    for (int axis = 0; axis < 3; ++axis) {
        for (int shift = 0; shift < 32; shift += 8)
            add(static_cast<std::uint8_t>(cells.size_vox()[axis] >> shift));
    }
    for (const std::uint8_t byte : cells.bytes()) add(byte);
    return hash;
}

}  // namespace tarn
