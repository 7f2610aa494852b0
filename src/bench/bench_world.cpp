#include "bench/bench_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace tarn {

namespace {

constexpr int side_unscaled_vox = 128;

Settings balanced() {
    Settings settings;
    apply_quality(settings, Quality::Balanced);
    return settings;
}

}  // namespace

std::string bench_scene_json(int side_vox, const char* lake) {
    using nlohmann::ordered_json;
    const double k = static_cast<double>(side_vox) / side_unscaled_vox;
    const auto cells = [&](double unscaled_vox) { return static_cast<int>(std::lround(unscaled_vox * k)); };
    const auto shape = [&](double x, double z, double rx, double rz, double height, double core,
                           double weight) {
        return ordered_json{{"center", {x * k, z * k}},
                            {"radius", {rx * k, rz * k}},
                            {"height_vox", height * k},
                            {"core", core},
                            {"weight", weight}};
    };
    const int octaves = std::clamp(5 + static_cast<int>(std::lround(std::log2(k))), 1, 10);
    const ordered_json terrain = {
        {"base_height_vox", 29 * k},
        {"amplitude_vox", 16 * k},
        {"wavelength_vox", 60 * k},
        {"octaves", octaves},
        {"persistence", 0.5},
        {"ridged", 0.15},
        {"warp_vox", 16 * k},
        {"bare_height_vox", 50 * k},
        {"shapes",
         {shape(28, 2, 56, 46, 62, 0, 0.8), shape(120, 12, 52, 50, 50, 0, 0.75),
          shape(64, 132, 110, 40, 25, 0.5, 0.8), shape(62, 70, 66, 50, 11, 0.25, 0.93),
          shape(84, 60, 20, 13, 29, 0.1, 0.9)}},
        {"beach", {{"height_vox", 24 * k}, {"depth_vox", 3}}},
        {"patches", {{"material", "dirt"}, {"cover", 0.38}, {"wavelength_vox", std::max(2.0, 7 * k)}}}};
    ordered_json scene;
    scene["size"] = {side_vox, side_vox, side_vox};
    scene["metres_per_voxel"] = 0.25 / k;
    scene["seed"] = 7;
    scene["camera"] = {
        {"position_vox", {50 * k, 36 * k, 125 * k}}, {"yaw_deg", 10}, {"pitch_deg", -12}, {"fov_deg", 58}};
    scene["sun"] = {{"azimuth_deg", 112}, {"elevation_deg", 38}};
    scene["sky"] = {{"model", "preetham"}, {"turbidity", 2.1}};
    scene["build"] = {
        {{"box", {{"min", {0, 0, 0}}, {"max", {side_vox, cells(22), side_vox}}, {"material", lake}}}},
        {{"terrain", terrain}}};
    return scene.dump(2) + "\n";
}

std::string bench_scene_name(int side_vox) {
    return fmt::format("terrain-{}", side_vox);
}

std::unique_ptr<BenchWorld> make_bench_world(int side_vox) {
    return std::make_unique<BenchWorld>(
        parse_scene(bench_scene_json(side_vox), bench_scene_name(side_vox), balanced()));
}

std::unique_ptr<BenchWorld> make_dry_bench_world(int side_vox) {
    return std::make_unique<BenchWorld>(
        parse_scene(bench_scene_json(side_vox, "stone"), fmt::format("dry-{}", side_vox), balanced()));
}

std::unique_ptr<BenchWorld> make_builtin_world(const std::string& name) {
    return std::make_unique<BenchWorld>(load_scene(name, balanced()));
}

}  // namespace tarn
