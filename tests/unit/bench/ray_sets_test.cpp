// The rays that the benchmark hands to all: where they start, where they go; and Embree, where it is built
// in, against the reference's walk.
#include "bench/ray_sets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/camera.h"
#include "bench/bench_world.h"
#include "bench/embree_scene.h"
#include "reference/traversal.h"
#include "world/scene.h"

namespace tarn {
namespace {

constexpr glm::ivec2 size_px{160, 90};

const Scene& terrain() {
    static const Scene scene = parse_scene(bench_scene_json(64), "terrain", Settings{});
    return scene;
}

const std::vector<RaySet>& sets() {
    static const std::vector<RaySet> all = make_ray_sets(terrain().cells, terrain().settings, size_px);
    return all;
}

double distance_of(const RaySet& set, const BenchRay& ray) {
    reference::RayStart start{glm::vec3(ray.origin_vox), glm::ivec3(ray.cell),
                              static_cast<std::uint32_t>(ray.cell.w)};
    double entry_vox = 0;
    if (set.from_eye) {
        const auto entry = reference::enter_world(terrain().cells, ray.origin_vox, ray.dir);
        if (!entry) return -1;
        start = entry->start;
        entry_vox = entry->t_entry;
    }
    const auto hit = reference::trace_ray(terrain().cells, start, ray.dir, reference::traversal_t_max);
    return hit.kind == reference::HitKind::None ? -1 : entry_vox + hit.t;
}

TEST(RaySets, HoldEveryKindInItsMedium) {
    ASSERT_EQ(sets().size(), 4u);
    EXPECT_EQ(sets()[0].name, "primary");
    EXPECT_EQ(sets()[0].rays.size(), std::size_t{1} * size_px.x * size_px.y);
    const glm::vec3 to_sun =
        camera_basis(terrain().settings.sun_azimuth_deg, terrain().settings.sun_elevation_deg).dir;
    std::size_t going_on = 0;
    for (const RaySet& set : sets()) {
        EXPECT_GT(set.rays.size(), 1000u) << set.name;
        for (const BenchRay& ray : set.rays) {
            // A few roundings of float32.
            EXPECT_NEAR(glm::length(glm::vec3(ray.dir)), 1, 1e-6) << set.name;
            if (set.from_eye) continue;
            const std::uint8_t byte = terrain().cells.at(glm::ivec3(ray.cell));
            EXPECT_EQ(material_of(byte), static_cast<std::uint32_t>(ray.cell.w)) << set.name;
            EXPECT_EQ(ray.cell.w, set.name == "in-water" ? MATERIAL_WATER : MATERIAL_AIR);
            if (set.name == "in-water") {
                // Through the level surface downwards, steeper than the critical angle: cos > sqrt(1 -
                // 1/n^2).
                EXPECT_LT(ray.dir.y, -0.66f);
            }
            if (set.name == "shadow") {
                EXPECT_EQ(glm::vec3(ray.dir), to_sun);
            }
        }
        if (set.name == "diffuse" || set.name == "in-water") going_on += set.rays.size();
    }
    EXPECT_LE(going_on, sets()[0].rays.size());
}

TEST(RaySets, DiffuseDirectionsFollowTheCosine) {
    // Over flat ground from above: E[cos] = 2/3, standard deviation of one sqrt(1/2 - 4/9).
    Scene flat = parse_scene(R"({"size": [32, 32, 32],
        "camera": {"position_vox": [16, 30, 16], "pitch_deg": -90, "fov_deg": 40},
        "build": [{"box": {"min": [0, 0, 0], "max": [32, 2, 32], "material": "stone"}}]})",
                             "flat", Settings{});
    const std::vector<RaySet> all = make_ray_sets(flat.cells, flat.settings, size_px);
    ASSERT_EQ(all.size(), 3u);  // no water
    ASSERT_EQ(all[1].name, "diffuse");
    double sum = 0;
    for (const BenchRay& ray : all[1].rays) {
        EXPECT_EQ(ray.origin_vox.y, 2);
        EXPECT_GE(ray.dir.y, 0);
        sum += ray.dir.y;
    }
    const auto n = static_cast<double>(all[1].rays.size());
    EXPECT_NEAR(sum / n, 2.0 / 3, 4 * std::sqrt((1.0 / 2 - 4.0 / 9) / n));  // 4 standard errors
}

TEST(RaySets, NeighboursShareATile) {
    const View view(terrain().settings, size_px);
    const std::vector<BenchRay>& rays = sets()[0].rays;
    for (const auto& [ray, x, y] : {std::tuple(0, 0, 0), {3, 3, 0}, {4, 0, 1}, {8, 4, 0}, {320, 0, 2}})
        EXPECT_EQ(glm::vec3(rays[static_cast<std::size_t>(ray)].dir),
                  view.dir_through(glm::vec2(x, y) + 0.5f))
            << ray;
}

TEST(RaySets, EmbreeFindsWhatTheReferenceFinds) {
    if (embree_version().empty()) {
        EXPECT_ANY_THROW(EmbreeScene(terrain().cells, 2));
        return;
    }
    const EmbreeScene embree(terrain().cells, 2);
    EXPECT_GT(embree.quads(), std::size_t{64} * 64 * 2);  // ground from above and from below, at least
    for (const RaySet& set : sets()) {
        std::vector<double> wanted;
        for (const BenchRay& ray : set.rays) wanted.push_back(distance_of(set, ray));
        const EmbreeRays rays(set);
        for (const bool packets : {true, false}) {
            std::vector<float> found;
            embree.trace(rays, packets, found);
            ASSERT_EQ(found.size(), wanted.size());
            std::size_t different = 0;
            for (std::size_t i = 0; i < found.size(); ++i) {
                const bool hits_agree = (found[i] < 0) == (wanted[i] < 0);
                const bool near = set.any_hit || wanted[i] < 0 || std::abs(found[i] - wanted[i]) < 0.01;
                different += !hits_agree || !near;
            }
            // Rays along edges and from corners differ by rounding and by Embree's nearest distance.
            EXPECT_LE(different, wanted.size() / 1000) << set.name << (packets ? " packets" : " single");
        }
    }
}

}  // namespace
}  // namespace tarn
