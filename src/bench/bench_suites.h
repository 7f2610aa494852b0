// The suites of `tarn bench`: each measures one side of Tarn and returns figures. Need a current context, but
// for `start`, which runs the program itself.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "bench/bench_world.h"
#include "bench/figures.h"

namespace tarn {

struct BenchOptions {
    std::vector<int> sides_vox{128, 256, 512};
    std::vector<glm::ivec2> frame_sizes_px{{640, 360}, {1280, 720}};
    int rounds = 5;
    int threads = 2;
    std::function<void(const std::string&)> progress = [](const std::string&) {};
};

struct BenchResult {
    std::vector<BenchFigure> figures;
    std::vector<std::string> notes;     // what was left out and why
    std::vector<std::string> failures;  // comparisons that mean nothing
};

void run_rays_suite(const BenchOptions& options, BenchResult& result);
void run_frame_suite(const BenchOptions& options, BenchResult& result);
void run_sim_suite(const BenchOptions& options, BenchResult& result);
void run_edit_suite(const BenchOptions& options, BenchResult& result);
void run_start_suite(const BenchOptions& options, BenchResult& result);
void run_variants_suite(const BenchOptions& options, BenchResult& result);

}  // namespace tarn
