// Rays a second: Tarn's walk with and without skipping, and Embree, given the same rays.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/bench_suites.h"
#include "bench/embree_scene.h"
#include "bench/ray_kernel.h"
#include "bench/ray_sets.h"

namespace tarn {

namespace {

constexpr glm::ivec2 size_px{640, 360};
constexpr double sample_least_ms = 100;
// Faces lie a voxel apart, but beside edges; Embree's floats err by far less.
constexpr double distance_tolerance_vox = 0.01;
// Rays along edges and into corners differ by rounding.
constexpr double agreement_least = 0.999;

struct RayCase {
    RaySet set;
    RayKernel skipping, voxel_by_voxel;
    EmbreeRays embree_rays;
    std::vector<float> embree_distance;

    explicit RayCase(RaySet set_)
        : set(std::move(set_)), skipping(set, true), voxel_by_voxel(set, false), embree_rays(set) {}
};

struct RayWorld {
    std::unique_ptr<BenchWorld> world;
    std::unique_ptr<EmbreeScene> embree;
    std::vector<std::unique_ptr<RayCase>> cases;
};

double agreement(const std::vector<float>& a, const std::vector<float>& b, bool any_hit) {
    std::size_t equal = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool both_miss = a[i] < 0 && b[i] < 0;
        const bool both_hit = a[i] >= 0 && b[i] >= 0;
        equal += both_miss || (both_hit && (any_hit || std::abs(a[i] - b[i]) <= distance_tolerance_vox));
    }
    return static_cast<double>(equal) / static_cast<double>(a.size());
}

void add_contestants(RayWorld& in, std::vector<Contestant>& contestants) {
    const std::string scene = in.world->scene.name;
    for (const auto& pointer : in.cases) {
        RayCase* const c = pointer.get();
        const auto add = [&](const char* who, const std::function<double()>& run_ms) {
            contestants.push_back(
                {.suite = "rays", .scene = scene, .who = who, .run = [c, run_ms] {
                     const double rays = static_cast<double>(c->set.rays.size());
                     return std::vector<Sample>{
                         {c->set.name, "Mrays/s", rays / mean_ms_of_runs(sample_least_ms, run_ms) / 1e3}};
                 }});
        };
        const Simulation* simulation = &in.world->simulation;
        add("tarn", [c, simulation] { return c->skipping.run(*simulation); });
        add("voxel", [c, simulation] { return c->voxel_by_voxel.run(*simulation); });
        if (!in.embree) continue;
        const EmbreeScene* embree = in.embree.get();
        add("embree-8", [c, embree] { return embree->trace(c->embree_rays, true, c->embree_distance); });
        add("embree-1", [c, embree] { return embree->trace(c->embree_rays, false, c->embree_distance); });
    }
}

// After the last round: rays a second of all kinds together, as many of each as the view asks for.
void add_totals(const RayWorld& in, std::vector<BenchFigure>& figures) {
    const std::string& scene = in.world->scene.name;
    for (const char* who : {"tarn", "voxel", "embree-8", "embree-1"}) {
        double rays = 0;
        std::vector<double> microseconds;  // of each round that all kinds took part in
        for (const auto& c : in.cases) {
            const BenchFigure* rate = find_figure(figures, {"rays", scene, c->set.name, who});
            if (rate == nullptr) return;
            const double count = static_cast<double>(c->set.rays.size());
            if (rays == 0) microseconds.assign(rate->samples.size(), 0);
            microseconds.resize(std::min(microseconds.size(), rate->samples.size()));
            for (std::size_t i = 0; i < microseconds.size(); ++i) microseconds[i] += count / rate->samples[i];
            rays += count;
        }
        for (const double us : microseconds)
            add_sample(figures, {"rays", scene, "all kinds", who}, "Mrays/s", rays / us);
    }
}

// After the last round: what the contestants found.
void compare_results(const RayWorld& in, BenchResult& result) {
    const std::string& scene = in.world->scene.name;
    for (const auto& c : in.cases) {
        const RayKernel::Result tarn = c->skipping.read();
        const RayKernel::Result voxel = c->voxel_by_voxel.read();
        const std::string& kind = c->set.name;
        const auto add = [&](const std::string& what, const char* who, const char* unit, double value) {
            add_sample(result.figures, {"rays", scene, fmt::format("{}: {}", kind, what), who}, unit, value);
        };
        add("rays", "all", "rays", static_cast<double>(c->set.rays.size()));
        add("steps", "tarn", "steps", tarn.mean_steps);
        add("steps", "voxel", "steps", voxel.mean_steps);
        // A word where the ray starts and one a step; cells are bytes.
        const double words = tarn.mean_steps + 1;
        add("fetches", "tarn", "fetches", words + tarn.mean_cells);
        add("fetches", "voxel", "fetches", voxel.mean_cells);
        add("bytes", "tarn", "bytes", words * sizeof(glm::uvec2) + tarn.mean_cells);
        add("bytes", "voxel", "bytes", voxel.mean_cells);
        if (tarn.distance_vox != voxel.distance_vox)
            result.failures.push_back(
                fmt::format("{} {}: skipping and voxel by voxel differ: one of them is wrong", scene, kind));
        if (!in.embree) continue;
        for (const bool packets : {true, false}) {
            in.embree->trace(c->embree_rays, packets, c->embree_distance);
            const double share = agreement(tarn.distance_vox, c->embree_distance, c->set.any_hit);
            const char* const who = packets ? "embree-8" : "embree-1";
            add("agree", who, "part", share);
            if (share < agreement_least)
                result.failures.push_back(
                    fmt::format("{} {}: Tarn and {} agree on {:.4f} of the rays, at least {}", scene, kind,
                                who, share, agreement_least));
        }
    }
}

}  // namespace

void run_rays_suite(const BenchOptions& options, BenchResult& result) {
    const bool with_embree = !embree_version().empty();
    if (!with_embree)
        result.notes.emplace_back(
            "rays: Embree is left out: this program was built without it (install libembree-dev, configure "
            "anew)");
    std::vector<RayWorld> worlds;
    std::vector<Contestant> contestants;
    for (const int side : options.sides_vox) {
        options.progress(fmt::format("rays: building {}", bench_scene_name(side)));
        RayWorld& in = worlds.emplace_back();
        in.world = make_bench_world(side);
        for (RaySet& set : make_ray_sets(in.world->scene.cells, in.world->scene.settings, size_px))
            in.cases.push_back(std::make_unique<RayCase>(std::move(set)));
        if (with_embree) {
            in.embree = std::make_unique<EmbreeScene>(in.world->scene.cells, options.threads);
            const std::string& scene = in.world->scene.name;
            const auto add = [&](const char* what, const char* unit, double value) {
                add_sample(result.figures, {"rays", scene, what, "embree"}, unit, value);
            };
            add("faces", "quads", static_cast<double>(in.embree->quads()));
            add("finding faces", "ms", in.embree->mesh_ms());
            add("build", "ms", in.embree->build_ms());
        }
        add_contestants(in, contestants);
    }
    run_rounds(contestants, {.rounds = options.rounds}, result.figures, options.progress);
    for (const RayWorld& in : worlds) add_totals(in, result.figures);
    for (const RayWorld& in : worlds) compare_results(in, result);
}

}  // namespace tarn
