// The worlds of the benchmark: one terrain with a lake, scaled to any side, seen by one camera that scales
// with it.
#pragma once
#include <memory>
#include <string>

#include "app/simulation.h"
#include "gl/timers.h"
#include "world/scene.h"

namespace tarn {

// The text of a scene file: `side_vox`^3 voxels, the hills of the scene `lake` times side / 128, with detail
// down to the voxel.
std::string bench_scene_json(int side_vox, const char* lake = "water");
std::string bench_scene_name(int side_vox);

struct BenchWorld {
    Scene scene;
    gl::Timers timers;
    Simulation simulation;

    explicit BenchWorld(Scene scene_) : scene(std::move(scene_)), simulation(scene, timers) {}
};

// Quality `balanced`. Both need a current context.
std::unique_ptr<BenchWorld> make_bench_world(int side_vox);
// The same land with stone in the lake's place.
std::unique_ptr<BenchWorld> make_dry_bench_world(int side_vox);
std::unique_ptr<BenchWorld> make_builtin_world(const std::string& name);

}  // namespace tarn
