// Worlds and rays for the tests of traversal, on the CPU and on the GPU: the same seeds give the same cases.
#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "reference/traversal.h"
#include "shared/hash.h"
#include "world/cells.h"

namespace tarn::cases {

class Random {
  public:
    explicit Random(std::uint32_t seed) : seed_(seed) {}
    std::uint32_t bits() { return hash2(seed_, counter_++); }
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint32_t>(n)); }
    float unit() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }  // [0,1)
    float between(float a, float b) { return a + (b - a) * unit(); }
    glm::vec3 point(glm::vec3 low, glm::vec3 high) {
        const float x = between(low.x, high.x);
        const float y = between(low.y, high.y);
        return {x, y, between(low.z, high.z)};
    }
    glm::vec3 direction() {
        for (;;) {
            const glm::vec3 v = point(glm::vec3(-1), glm::vec3(1));
            const float length2 = glm::dot(v, v);
            if (length2 > 0.01f && length2 <= 1) return v / std::sqrt(length2);
        }
    }

  private:
    std::uint32_t seed_, counter_ = 0;
};

enum class WorldKind { Sparse, Dense, Terrain, Amounts, Deep, Air };

// Sparse: one solid voxel in 4000. Dense: four in ten, glass among them. Terrain: hills, a lake, a lake's
// surface of all amounts. Amounts: water of every amount in every third voxel. Deep: full water with a few
// stones.
inline Cells make_world(WorldKind kind, glm::ivec3 size, std::uint32_t seed) {
    Random random(seed);
    Cells cells(size);
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                std::uint8_t& cell = cells.at({x, y, z});
                const int dice = random.below(4000);
                const auto amount = static_cast<std::uint8_t>(MATERIAL_WATER + random.below(16));
                const double hill = size.y * (0.35 + 0.2 * std::sin(x * 0.21) * std::cos(z * 0.17 + 1));
                switch (kind) {
                    case WorldKind::Sparse:
                        if (dice == 0) cell = MATERIAL_STONE;
                        break;
                    case WorldKind::Dense:
                        if (dice < 1600) cell = static_cast<std::uint8_t>(1 + dice % 8);
                        break;
                    case WorldKind::Terrain:
                        if (y < hill) {
                            cell = MATERIAL_STONE;
                        } else if (y < size.y / 3) {
                            cell = MATERIAL_WATER_FULL;
                        } else if (y == size.y / 3) {
                            cell = amount;
                        }
                        break;
                    case WorldKind::Amounts:
                        if (dice < 1300)
                            cell = amount;
                        else if (dice < 1500)
                            cell = MATERIAL_STONE;
                        break;
                    case WorldKind::Air:
                        if (x + y + z == 0) cell = MATERIAL_STONE;
                        break;
                    case WorldKind::Deep:
                        cell = dice == 0 ? MATERIAL_STONE : static_cast<std::uint8_t>(MATERIAL_WATER_FULL);
                        break;
                }
            }
        }
    }
    return cells;
}

struct EyeRay {
    glm::vec3 origin_vox, dir;
    float t_max_vox = 1e9f;
};

// A ray in general position from inside the world.
inline EyeRay random_ray(glm::ivec3 size, Random& random) {
    const glm::vec3 origin = random.point(glm::vec3(0), glm::vec3(size));
    return {origin, random.direction()};
}

// A ray from a multiple of half a voxel towards a small whole-number direction: ties at edges and corners.
// Zeros have either sign.
inline EyeRay lattice_ray(glm::ivec3 size, Random& random) {
    const glm::ivec3 halves{random.below(2 * size.x + 1), random.below(2 * size.y + 1),
                            random.below(2 * size.z + 1)};
    glm::ivec3 v(0);
    while (v == glm::ivec3(0)) v = {random.below(9) - 4, random.below(9) - 4, random.below(9) - 4};
    glm::vec3 dir = glm::vec3(v) / std::sqrt(static_cast<float>(v.x * v.x + v.y * v.y + v.z * v.z));
    for (int k = 0; k < 3; ++k)
        if (v[k] == 0 && random.below(2) == 0) dir[k] = -0.0f;
    return {glm::vec3(halves) * 0.5f, dir};
}

// A mixture that contains every case of LIGHT.md's extremes: lattice rays, axis rays, components too small to
// matter, eyes outside and a million voxels away, and short limits.
inline EyeRay hard_ray(glm::ivec3 size, Random& random) {
    EyeRay ray = random.below(2) == 0 ? random_ray(size, random) : lattice_ray(size, random);
    switch (random.below(8)) {
        case 0: {  // along an axis
            const int axis = random.below(3);
            const float sign = random.below(2) == 0 ? -1.0f : 1.0f;
            ray.dir = glm::vec3(random.below(2) == 0 ? -0.0f : 0.0f);
            ray.dir[axis] = sign;
            break;
        }
        case 1: {  // one component tiny, at times too tiny to count
            constexpr float tiny[] = {1e-38f, -1e-37f, 1e-30f, -1e-20f, 1e-12f, -1e-7f};
            glm::vec3 dir = ray.dir;
            dir[random.below(3)] = tiny[random.below(6)];
            if (glm::dot(dir, dir) > 0.01f) ray.dir = dir;
            ray.dir /= std::sqrt(glm::dot(ray.dir, ray.dir));
            break;
        }
        case 2: {  // from outside, towards a point inside
            const glm::vec3 target = random.point(glm::vec3(0), glm::vec3(size));
            constexpr float far[] = {0.5f, 3, 100, 1e4f, 1e6f};
            ray.origin_vox = target - far[random.below(5)] * random.direction() * glm::vec3(size);
            const glm::vec3 way = target - ray.origin_vox;
            ray.dir = way / std::sqrt(glm::dot(way, way));
            break;
        }
        case 3:  // from outside along the lattice
            ray.origin_vox -= ray.dir * static_cast<float>(4 << random.below(18));
            break;
        case 4:  // a short limit
            ray.t_max_vox = random.below(4) == 0 ? 0.0f : random.between(0, 6);
            break;
        default:
            break;
    }
    return ray;
}

// The ray that goes on from a hit: half of them back into the medium they came from, half into the one
// beyond.
inline reference::RayStart after_hit(const reference::RayStart& start, glm::vec3 dir,
                                     const reference::RayHit& hit, Random& random, glm::vec3& next_dir) {
    const bool reflected = random.below(2) == 0;
    next_dir = random.below(4) == 0 ? lattice_ray(glm::ivec3(1), random).dir : random.direction();
    const bool forward = dir[hit.axis] > 0;
    const float along = std::abs(next_dir[hit.axis]);
    next_dir[hit.axis] = forward != reflected ? along : -along;
    return {.origin_vox = reference::hit_point(start, dir, hit),
            .cell = reflected ? hit.previous : hit.cell,
            .medium = reflected ? start.medium : hit.beyond};
}

}  // namespace tarn::cases
