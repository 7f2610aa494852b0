#include "measure/light_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>

#include "app/renderer.h"
#include "app/simulation.h"
#include "world/scene.h"

namespace tarn {

namespace {

// A lamp of one voxel under the ceiling of a room of 12.8 m.
constexpr const char* lamp_room = R"({"size": [64, 48, 64], "metres_per_voxel": 0.2,
    "camera": {"position_vox": [32, 22, 60], "pitch_deg": -8, "fov_deg": 70},
    "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
    "materials": {"lamp": {"emission": [4000, 3500, 2800]}},
    "build": [{"box": {"min": [0, 0, 0], "max": [64, 48, 64], "material": "wall"}},
              {"box": {"min": [1, 1, 1], "max": [63, 47, 63], "material": "air"}},
              {"box": {"min": [14, 1, 20], "max": [24, 18, 30], "material": "stone"}},
              {"box": {"min": [40, 1, 12], "max": [46, 30, 18], "material": "sand"}},
              {"box": {"min": [30, 38, 34], "max": [31, 39, 35], "material": "lamp"}}]})";

// A bed 5 m under smooth water, lit by a sun large enough for chance to find.
constexpr const char* lake_bed = R"({"size": [48, 32, 48], "metres_per_voxel": 0.5,
    "camera": {"position_vox": [24, 26, 46], "pitch_deg": -40, "fov_deg": 60},
    "sun": {"azimuth_deg": 60, "elevation_deg": 50, "irradiance": [4, 3.6, 3], "angular_radius_deg": 10},
    "sky": {"zenith": [0.1, 0.2, 0.5], "horizon": [0.3, 0.4, 0.5]},
    "build": [{"box": {"min": [0, 0, 0], "max": [48, 2, 48], "material": "sand"}},
              {"box": {"min": [20, 2, 16], "max": [28, 9, 24], "material": "stone"}},
              {"box": {"min": [0, 2, 0], "max": [48, 12, 48], "material": "water"}}]})";

// Blocks under an open sky without a sun.
constexpr const char* open_sky = R"({"size": [48, 32, 48],
    "camera": {"position_vox": [24, 20, 46], "pitch_deg": -30, "fov_deg": 60},
    "sun": {"azimuth_deg": 60, "elevation_deg": 30, "irradiance": [0, 0, 0]},
    "build": [{"box": {"min": [0, 0, 0], "max": [48, 2, 48], "material": "grass"}},
              {"box": {"min": [8, 2, 8], "max": [20, 14, 20], "material": "stone"}},
              {"box": {"min": [28, 2, 20], "max": [40, 8, 32], "material": "wall"}}]})";

struct Run {
    const LightStrategy& strategy;
    Scene scene;
    gl::Timers timers;
    Simulation simulation;
    Renderer renderer;
    std::vector<double> sum, square;  // of each pixel's luminance, over the rounds
    std::vector<double> ms;

    Run(const LightStrategy& strategy_, Scene scene_)
        : strategy(strategy_), scene(std::move(scene_)), simulation(scene, timers), renderer(scene, timers) {}
};

Scene scene_for(const LightScenario& scenario, const LightStrategy& strategy,
                const std::vector<std::string>& set) {
    Settings exact;
    apply_quality(exact, Quality::Exact);
    const std::string_view text = scenario.scene;
    Scene scene = text.front() == '{' ? parse_scene(scenario.scene, scenario.name, exact)
                                      : load_scene(scenario.scene, exact);
    for (const char* assignment : strategy.set) set_assignment(scene.settings, assignment);
    for (const std::string& assignment : set) set_assignment(scene.settings, assignment);
    return scene;
}

void render_round(Run& run, const LightOptions& options, bool counted) {
    run.renderer.reset_history();
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < options.samples; ++i)
        run.renderer.render(run.simulation, run.scene.settings, options.size_px);
    const ImageRgb32f image = run.renderer.read_radiance();
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    run.timers.end_frame();
    if (!counted) return;
    run.ms.push_back(taken.count() / options.samples);
    for (std::size_t p = 0; p < run.sum.size(); ++p) {
        const float* rgb = &image.pixels[3 * p];
        const double y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        run.sum[p] += y;
        run.square[p] += y * y;
    }
}

// `reference`: each pixel's luminance, of the strategy with the least noise.
LightRow row_of(const LightScenario& scenario, Run& run, const std::vector<double>& reference,
                const LightOptions& options) {
    LightRow row{.scenario = scenario.name, .strategy = run.strategy.name};
    const double n = options.rounds;
    const auto pixels = static_cast<double>(run.sum.size());
    const double mean = std::accumulate(reference.begin(), reference.end(), 0.0) / pixels;
    double variance_of_round = 0;
    for (std::size_t p = 0; p < run.sum.size(); ++p) {
        row.mean += run.sum[p] / n / pixels;
        const double variance = std::max(0.0, run.square[p] - run.sum[p] * run.sum[p] / n) / (n - 1);
        variance_of_round += variance;
        row.relative_variance +=
            variance * options.samples / (reference[p] * reference[p] + 0.01 * mean * mean) / pixels;
    }
    row.standard_error = std::sqrt(variance_of_round / n) / pixels;
    std::sort(run.ms.begin(), run.ms.end());
    row.sample_ms = run.ms[run.ms.size() / 2];
    row.rejected = run.renderer.rejected_samples();
    return row;
}

}  // namespace

std::span<const LightScenario> light_scenarios() {
    static const std::vector<LightStrategy> emitters = {{"chance", {"light_sampling=none"}},
                                                        {"lights", {"light_sampling=lights"}}};
    static const LightScenario scenarios[] = {
        {"cave", "the flooded cave: lamps of 3x2x3 voxels, half of the picture seen through water", "cave",
         emitters},
        {"lamp-room", "a bright lamp of one voxel in a room of 64x48x64", lamp_room, emitters},
        {"lake-bed",
         "a bed under smooth water, a sun of 10 degrees: connected through the surface, or found by chance",
         lake_bed,
         {{"chance", {"light_sampling=none", "sun_through_water=false"}}, {"lights", {}}}},
        {"sky",
         "blocks under an open sky: the sky found by scattered paths, or sampled as well",
         open_sky,
         {{"lights", {}}, {"all", {"light_sampling=all"}}}}};
    return scenarios;
}

bool is_set_by(const LightScenario& scenario, std::string_view key) {
    return std::any_of(scenario.strategies.begin(), scenario.strategies.end(), [&](const LightStrategy& s) {
        return std::any_of(s.set.begin(), s.set.end(), [&](std::string_view assignment) {
            return assignment.substr(0, assignment.find('=')) == key;
        });
    });
}

std::vector<LightRow> measure_light(const LightScenario& scenario, const LightOptions& options,
                                    const std::function<void(double)>& progress) {
    std::vector<std::unique_ptr<Run>> runs;
    for (const LightStrategy& strategy : scenario.strategies) {
        Scene scene = scene_for(scenario, strategy, options.set);
        // Numbers of their own: the means are compared as independent.
        scene.seed += static_cast<std::uint32_t>(runs.size());
        runs.push_back(std::make_unique<Run>(strategy, std::move(scene)));
        const auto pixels = static_cast<std::size_t>(options.size_px.x) * options.size_px.y;
        runs.back()->sum.assign(pixels, 0);
        runs.back()->square.assign(pixels, 0);
    }
    // The first round compiles.
    for (int round = 0; round <= options.rounds; ++round) {
        for (const auto& run : runs) render_round(*run, options, round > 0);
        progress(static_cast<double>(round + 1) / (options.rounds + 1));
    }
    std::vector<LightRow> rows;
    std::vector<double> reference = runs.back()->sum;
    for (double& y : reference) y /= options.rounds;
    rows.reserve(runs.size());
    for (const auto& run : runs) {
        LightRow& row = rows.emplace_back(row_of(scenario, *run, reference, options));
        const LightRow& first = rows.front();
        const double error = std::hypot(row.standard_error, first.standard_error);
        if (&row != &first && error > 0) row.off_by = (row.mean - first.mean) / error;
        const double cost = row.relative_variance * row.sample_ms;
        if (cost > 0) row.gain = first.relative_variance * first.sample_ms / cost;
    }
    return rows;
}

std::string light_text(std::span<const LightRow> rows) {
    std::string text =
        fmt::format("{:<10} {:<9} {:>10} {:>10} {:>7} {:>12} {:>10} {:>18} {:>9}\n", "scenario", "strategy",
                    "mean", "error", "off_by", "rel_variance", "ms_sample", "equal_time_gain", "rejected");
    for (const LightRow& r : rows)
        text +=
            fmt::format("{:<10} {:<9} {:>10.5g} {:>10.2g} {:>+7.2f} {:>12.4g} {:>10.2f} {:>18.1f} {:>9}\n",
                        r.scenario, r.strategy, r.mean, r.standard_error, r.off_by, r.relative_variance,
                        r.sample_ms, r.gain, r.rejected);
    return text;
}

std::string light_csv(std::span<const LightRow> rows) {
    std::string text =
        "scenario,strategy,mean,standard_error,off_by,relative_variance,sample_ms,equal_time_gain,rejected\n";
    for (const LightRow& r : rows)
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.scenario, r.strategy, r.mean, r.standard_error,
                            r.off_by, r.relative_variance, r.sample_ms, r.gain, r.rejected);
    return text;
}

}  // namespace tarn
