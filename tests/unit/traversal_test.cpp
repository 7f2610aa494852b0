#include "reference/traversal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "reference/exact_traversal.h"
#include "traversal_cases.h"

namespace tarn::reference {
namespace {

using cases::EyeRay;
using cases::Random;
using cases::WorldKind;

constexpr float far_vox = 1e9f;

RayHit trace_from_eye(const Cells& cells, glm::vec3 origin, glm::vec3 dir, float t_max_vox = far_vox) {
    const auto entry = enter_world(cells, origin, dir);
    return entry ? trace_ray(cells, entry->start, dir, t_max_vox) : RayHit{};
}

// 9^3 of air with one stone in the middle.
Cells one_stone() {
    Cells cells({9, 9, 9});
    cells.at({4, 4, 4}) = MATERIAL_STONE;
    return cells;
}

TEST(Traversal, Fault2_RaysAlongAnAxisHit) {
    const Cells cells = one_stone();
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0f, -1.0f}) {
            for (const float zero : {0.0f, -0.0f}) {
                for (const float from : {4.5f - 3 * sign, 4.5f - 100 * sign, 4.5f - 1e6f * sign}) {
                    glm::vec3 origin(4.25f);
                    glm::vec3 dir(zero);
                    origin[axis] = from;
                    dir[axis] = sign;
                    const auto entry = enter_world(cells, origin, dir);
                    ASSERT_TRUE(entry);
                    const RayHit hit = trace_ray(cells, entry->start, dir, far_vox);
                    ASSERT_EQ(hit.kind, HitKind::Face);
                    EXPECT_EQ(hit.cell, glm::ivec3(4));
                    EXPECT_EQ(hit.axis, axis);
                    EXPECT_EQ(hit.beyond, MATERIAL_STONE);
                    EXPECT_EQ(entry->t_entry + hit.t, std::abs(from - 4.5f) - 0.5f);
                    EXPECT_EQ(hit_point(entry->start, dir, hit)[axis], sign > 0 ? 4.0f : 5.0f);
                }
            }
        }
    }
}

TEST(Traversal, Fault2_RaysFromAVoxelsBoundaryStartInTheVoxelAhead) {
    const Cells cells = one_stone();
    // From faces, edges and corners of the voxel lattice, straight at the stone's centre.
    for (int z = 0; z <= 18; ++z) {
        for (int y = 0; y <= 18; ++y) {
            for (int x = 0; x <= 18; ++x) {
                const glm::vec3 origin = glm::vec3(x, y, z) * 0.5f;
                if (glm::all(glm::lessThan(glm::abs(origin - 4.5f), glm::vec3(1)))) continue;
                const glm::vec3 way = glm::vec3(4.5f) - origin;
                const glm::vec3 dir = way / std::sqrt(glm::dot(way, way));
                const RayHit hit = trace_from_eye(cells, origin, dir);
                ASSERT_EQ(hit.kind, HitKind::Face) << x << " " << y << " " << z;
                ASSERT_EQ(hit.cell, glm::ivec3(4)) << x << " " << y << " " << z;
            }
        }
    }
    // On a plane with that component negative the ray is in the lower voxel.
    EXPECT_EQ(enter_world(cells, {5, 4.5f, 4.5f}, {-1, 0, 0})->start.medium, MATERIAL_STONE);
    EXPECT_EQ(enter_world(cells, {5, 4.5f, 4.5f}, {1, 0, 0})->start.medium, MATERIAL_AIR);
    EXPECT_EQ(enter_world(cells, {4, 4.5f, 4.5f}, {1, 0, 0})->start.medium, MATERIAL_STONE);
}

TEST(Traversal, Fault7_ARayInWaterThatRunsOutReturnsNoHit) {
    Cells cells({16, 16, 16});
    for (std::uint8_t& byte : cells.bytes()) byte = MATERIAL_WATER_FULL;
    Random random(7);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 origin = random.point(glm::vec3(6), glm::vec3(10));
        const glm::vec3 dir = random.direction();
        const RayHit out_of_range = trace_from_eye(cells, origin, dir, 5.5f);
        EXPECT_EQ(out_of_range.kind, HitKind::None);
        EXPECT_EQ(out_of_range.t, 5.5f);
        const RayHit leaves = trace_from_eye(cells, origin, dir);
        ASSERT_EQ(leaves.kind, HitKind::Face);
        EXPECT_EQ(leaves.beyond, MATERIAL_AIR);
        EXPECT_EQ(leaves.byte_beyond, 0u);
        EXPECT_FALSE(cells.contains(leaves.cell));
        EXPECT_GT(leaves.t, 5.5f);
    }
}

TEST(Traversal, EqualMediaHaveNoInterface) {
    Cells cells({6, 3, 3});
    for (std::uint8_t& byte : cells.bytes()) byte = MATERIAL_GLASS;
    cells.at({4, 1, 1}) = MATERIAL_WATER_FULL;
    const RayHit hit = trace_from_eye(cells, {0.5f, 1.5f, 1.5f}, {1, 0, 0});
    EXPECT_EQ(hit.kind, HitKind::Face);
    EXPECT_EQ(hit.cell, glm::ivec3(4, 1, 1));
    EXPECT_EQ(hit.beyond, MATERIAL_WATER);
    EXPECT_EQ(hit.byte_beyond, MATERIAL_WATER_FULL);
    EXPECT_EQ(hit.t, 3.5f);
    EXPECT_EQ(trace_from_eye(cells, {0.5f, 0.5f, 0.5f}, {1, 0, 0}).t, 5.5f) << "glass ends with the world";
}

TEST(Traversal, APartlyFilledVoxelIsWaterBelowItsSurface) {
    for (std::uint32_t quanta = 1; quanta < QUANTA_PER_VOXEL; ++quanta) {
        Cells cells({3, 4, 3});
        for (int z = 0; z < 3; ++z)
            for (int x = 0; x < 3; ++x) cells.at({x, 1, z}) = static_cast<std::uint8_t>(water_cell(quanta));
        const float surface = 1 + static_cast<float>(quanta) / 16;

        const RayHit down = trace_from_eye(cells, {1.5f, 3.5f, 1.5f}, {0, -1, 0});
        EXPECT_EQ(down.kind, HitKind::Surface);
        EXPECT_EQ(down.cell, glm::ivec3(1));
        EXPECT_EQ(down.previous, glm::ivec3(1));
        EXPECT_EQ(down.beyond, MATERIAL_WATER);
        EXPECT_EQ(down.t, 3.5f - surface);

        const RayHit up = trace_from_eye(cells, {1.5f, 0.5f, 1.5f}, {0, 1, 0});
        EXPECT_EQ(up.kind, HitKind::Face);
        EXPECT_EQ(up.beyond, MATERIAL_WATER);
        const RayHit out =
            trace_ray(cells, {{1.5f, 1, 1.5f}, glm::ivec3(1), MATERIAL_WATER}, {0, 1, 0}, far_vox);
        EXPECT_EQ(out.kind, HitKind::Surface);
        EXPECT_EQ(out.beyond, MATERIAL_AIR);
        EXPECT_EQ(out.t, surface - 1);

        EXPECT_EQ(trace_from_eye(cells, {-1, surface, 1.5f}, {1, 0, 0}).kind, HitKind::None) << "just above";
        const RayHit side = trace_from_eye(cells, {-1, surface - 0.01f, 1.5f}, {1, 0, 0});
        EXPECT_EQ(side.kind, HitKind::Face);
        EXPECT_EQ(side.cell, glm::ivec3(0, 1, 1));
        EXPECT_EQ(side.beyond, MATERIAL_WATER);
        EXPECT_EQ(enter_world(cells, {1.5f, surface, 1.5f}, {1, 0, 0})->start.medium, MATERIAL_AIR);
        EXPECT_EQ(enter_world(cells, {1.5f, surface - 0.01f, 1.5f}, {1, 0, 0})->start.medium, MATERIAL_WATER);
    }
}

TEST(Traversal, AFlatSurfaceShowsNoSeamBetweenItsVoxels) {
    Cells cells({32, 3, 32});
    for (int z = 0; z < 32; ++z) {
        for (int x = 0; x < 32; ++x) {
            cells.at({x, 0, z}) = MATERIAL_WATER_FULL;
            cells.at({x, 1, z}) = static_cast<std::uint8_t>(water_cell(5));
        }
    }
    Random random(11);
    for (int i = 0; i < 100000; ++i) {
        // Slanting rays through edges between voxels among them.
        glm::vec3 target = random.point({1, 1.3125f, 1}, {31, 1.3125f, 31});
        if (i % 2 == 0) target.x = std::round(target.x);
        const float sign = i % 4 < 2 ? 1.0f : -1.0f;
        const glm::vec3 away(random.between(-1, 1), 0.01f + 0.5f * random.unit(), random.between(-1, 1));
        const glm::vec3 dir = -sign * away / std::sqrt(glm::dot(away, away));
        const RayHit hit = trace_from_eye(cells, target - 0.9f * dir, dir);
        ASSERT_EQ(hit.kind, HitKind::Surface) << i;
        ASSERT_NEAR(hit.t, 0.9f, 1e-3f);
    }
}

// What is at a point, without a walk.
std::uint32_t medium_at(const Cells& cells, glm::dvec3 point) {
    const glm::ivec3 cell(glm::floor(point));
    const std::uint32_t byte = cells.get(cell, MATERIAL_AIR);
    if (!is_partly_filled(byte)) return material_of(byte);
    return point.y < cell.y + quanta_of(byte) / 16.0 ? std::uint32_t{MATERIAL_WATER} : MATERIAL_AIR;
}

TEST(Traversal, TheMediumIsTheSameUpToAHitAndAnotherBehindIt) {
    for (const WorldKind kind : {WorldKind::Dense, WorldKind::Terrain, WorldKind::Amounts}) {
        const Cells cells = cases::make_world(kind, {21, 17, 26}, 3);
        Random random(5);
        int hits = 0;
        int behind = 0;
        for (int i = 0; i < 20000; ++i) {
            const EyeRay ray = cases::random_ray(cells.size_vox(), random);
            const auto entry = enter_world(cells, ray.origin_vox, ray.dir);
            ASSERT_TRUE(entry);
            const RayHit hit = trace_ray(cells, entry->start, ray.dir, far_vox);
            const double length = hit.kind == HitKind::None ? 50.0 : double{hit.t};
            int strangers = 0;  // samples that rounding puts across an edge
            for (int k = 0; k < 100; ++k) {
                const glm::dvec3 point =
                    glm::dvec3(ray.origin_vox) + glm::dvec3(ray.dir) * (length * random.unit());
                strangers += medium_at(cells, point) != entry->start.medium;
            }
            ASSERT_LE(strangers, length < 1e-3 ? 100 : 1) << i;
            if (hit.kind == HitKind::None) continue;
            const glm::dvec3 point = glm::dvec3(ray.origin_vox) + glm::dvec3(ray.dir) * (hit.t + 1e-4);
            ++hits;
            behind += medium_at(cells, point) == hit.beyond;
            ASSERT_NE(hit.beyond, entry->start.medium);
        }
        EXPECT_GT(hits, 8000);
        EXPECT_GT(behind, 0.995 * hits) << "all but those that rounding puts across an edge";
    }
}

TEST(Traversal, HitPointsLieOnTheirPlaneAndInTheVoxel) {
    const Cells cells = cases::make_world(WorldKind::Amounts, {30, 20, 25}, 9);
    Random random(1);
    for (int i = 0; i < 50000; ++i) {
        const EyeRay ray = cases::hard_ray(cells.size_vox(), random);
        const auto entry = enter_world(cells, ray.origin_vox, ray.dir);
        if (!entry) continue;
        const RayHit hit = trace_ray(cells, entry->start, ray.dir, ray.t_max_vox);
        ASSERT_TRUE(std::isfinite(hit.t));
        ASSERT_GE(hit.t, 0);
        ASSERT_LE(hit.t, ray.t_max_vox);
        if (hit.kind == HitKind::None) continue;
        const glm::vec3 point = hit_point(entry->start, ray.dir, hit);
        for (const glm::ivec3 cell : {hit.previous, hit.cell}) {
            ASSERT_TRUE(glm::all(glm::greaterThanEqual(point, glm::vec3(cell))));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(point, glm::vec3(cell + 1))));
        }
        // The ray that goes straight on is in the next medium and never meets the same face again.
        const RayStart next{point, hit.cell, hit.beyond};
        const RayHit on = trace_ray(cells, next, ray.dir, far_vox);
        EXPECT_TRUE(on.kind == HitKind::None || on.beyond != hit.beyond);
    }
}

TEST(Traversal, EyesFarOutsideSeeTheWorldOrMissIt) {
    Cells cells({7, 13, 5});
    for (std::uint8_t& byte : cells.bytes()) byte = MATERIAL_STONE;
    Random random(2);
    for (const float distance : {20.0f, 1e3f, 1e6f}) {
        for (int i = 0; i < 2000; ++i) {
            const glm::vec3 target = random.point({1, 1, 1}, {6, 12, 4});
            const glm::vec3 dir = random.direction();
            const glm::vec3 origin = target - distance * dir;
            const auto entry = enter_world(cells, origin, dir);
            ASSERT_TRUE(entry);
            const RayHit hit = trace_ray(cells, entry->start, dir, far_vox);
            ASSERT_EQ(hit.kind, HitKind::Face);
            EXPECT_EQ(hit.t, 0) << "the entry face is the hit";
            EXPECT_TRUE(cells.contains(hit.cell));
            EXPECT_FALSE(cells.contains(hit.previous));
            EXPECT_FALSE(enter_world(cells, origin, -dir));
        }
    }
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(enter_world(cells, glm::vec3(nan), {1, 0, 0}));
    EXPECT_FALSE(enter_world(cells, {-infinity, 1, 1}, {1, 0, 0}));
    EXPECT_FALSE(enter_world(cells, {-3e38f, 1, 1}, {1, 0, 0}));
    EXPECT_FALSE(enter_world(cells, {7, 1, 1}, {1, 0, 0})) << "on the far side, leaving";
    EXPECT_TRUE(enter_world(cells, {7, 1, 1}, {-1, 0, 0}));
    EXPECT_FALSE(enter_world(cells, {7, 1, 1}, {0, 1, 0})) << "along the far side";
    EXPECT_TRUE(enter_world(cells, {0, 1, 1}, {0, 1, 0})) << "along the near side";
}

bool same_hit(const RayHit& a, const RayHit& b) {
    return a.kind == b.kind && a.cell == b.cell && a.previous == b.previous && a.axis == b.axis &&
           a.beyond == b.beyond;
}

// True if some ray within two units in the last place of the direction, exactly walked, meets what `hit`
// says.
bool explained_by_rounding(const Cells& cells, const RayStart& start, glm::vec3 dir, const RayHit& hit) {
    const auto nudged = [](float value, int steps) {
        for (; steps > 0; --steps) value = std::nextafter(value, 2.0f);
        for (; steps < 0; ++steps) value = std::nextafter(value, -2.0f);
        return value;
    };
    for (int code = 0; code < 125; ++code) {
        const glm::ivec3 steps(code % 5 - 2, code / 5 % 5 - 2, code / 25 - 2);
        glm::vec3 near = dir;
        for (int k = 0; k < 3; ++k)
            if (dir[k] != 0) near[k] = nudged(dir[k], steps[k]);
        if (same_hit(trace_ray_exact(cells, start, near), hit)) return true;
    }
    return false;
}

struct Disagreement {
    int rays = 0, hits = 0, unexplained = 0;
};

// How often float32 and exact arithmetic meet another voxel, face or medium from the same start.
template <typename MakeRay>
Disagreement compare_with_exact(int rays, const MakeRay& make_ray) {
    Disagreement out;
    Random random(17);
    for (const WorldKind kind :
         {WorldKind::Sparse, WorldKind::Dense, WorldKind::Terrain, WorldKind::Amounts}) {
        const Cells cells = cases::make_world(kind, {61, 37, 45}, 4);
        for (int i = 0; i < rays / 4; ++i) {
            const EyeRay ray = make_ray(cells.size_vox(), random);
            const auto entry = enter_world(cells, ray.origin_vox, ray.dir);
            if (!entry) continue;
            const RayHit hit = trace_ray(cells, entry->start, ray.dir, far_vox);
            ++out.rays;
            if (same_hit(hit, trace_ray_exact(cells, entry->start, ray.dir))) continue;
            ++out.hits;
            out.unexplained += !explained_by_rounding(cells, entry->start, ray.dir, hit);
        }
    }
    return out;
}

// Two planes pass within the resolution of float32 on about one random ray in two million where it matters
// (17 of 30 million over five kinds of world and three sizes): no walk in float32 is free of that. Anything
// else is a bug.
TEST(ExactTraversal, Float32DiffersOnNoRandomRayButNearTies) {
    const Disagreement found = compare_with_exact(1000000, cases::random_ray);
    std::printf("random rays: float32 and exact arithmetic differ on %d of %d\n", found.hits, found.rays);
    EXPECT_EQ(found.rays, 1000000);
    EXPECT_LE(found.hits, 3);
    EXPECT_EQ(found.unexplained, 0);
}

// Rays through edges and corners: 1.0 % differ, where 1 / d rounds a tie apart.
TEST(ExactTraversal, Float32DiffersOnFewLatticeRays) {
    const Disagreement found = compare_with_exact(1000000, cases::lattice_ray);
    std::printf("lattice rays: float32 and exact arithmetic differ on %d of %d, %d by more than one tie\n",
                found.hits, found.rays, found.unexplained);
    EXPECT_GT(found.rays, 900000);
    EXPECT_LT(found.hits, 12000);
    EXPECT_LT(found.unexplained, 200);
}

TEST(ExactTraversal, DecidesTiesThatFloat32CannotSee) {
    Cells cells({40, 40, 3});
    cells.at({30, 29, 1}) = MATERIAL_STONE;  // right of the diagonal, met only if x goes first
    const float near_one = 1 - 0x1p-24f;
    const RayStart start{{0.5f, 0.5f, 1.5f}, {0, 0, 1}, MATERIAL_AIR};
    EXPECT_EQ(trace_ray_exact(cells, start, {1, 1, 0}).kind, HitKind::Face) << "a tie: x before y";
    EXPECT_EQ(trace_ray_exact(cells, start, {1, near_one, 0}).kind, HitKind::Face);
    EXPECT_EQ(trace_ray_exact(cells, start, {near_one, 1, 0}).kind, HitKind::None);
}

}  // namespace
}  // namespace tarn::reference
