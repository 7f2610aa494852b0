// From the start of the program to its first picture, on disk, by running it: cold, with the caches of
// shaders that the driver and Tarn keep empty, and warm, with what the cold run left in them. The system's
// own cache of files is warm in both. And the memory that each needs.
#include <filesystem>

#include "bench/bench_suites.h"
#include "bench/child.h"
#include "core/files.h"

namespace tarn {

namespace {

struct StartCase {
    std::string name;
    std::string scene;  // as --scene takes it
};

}  // namespace

void run_start_suite(const BenchOptions& options, BenchResult& result) {
    const TemporaryFolder folder;
    std::vector<StartCase> cases{{"lake", "lake"}};
    for (const int side : options.sides_vox) {
        const std::string path = folder.path() + "/" + bench_scene_name(side) + ".json";
        write_file(path, bench_scene_json(side));
        cases.push_back({bench_scene_name(side), path});
    }
    const std::string caches = folder.path() + "/caches";
    const auto start = [&](const StartCase& c) {
        const ChildRun run = run_self({"render", "--scene", c.scene, "--size", "640x360", "--frames", "1",
                                       "--out", folder.path() + "/first.png"},
                                      {{"XDG_CACHE_HOME", caches}, {"MESA_SHADER_CACHE_DIR", caches}});
        return std::vector<Sample>{{"first frame", "s", run.wall_s}, {"peak memory", "MiB", run.peak_mib}};
    };
    std::vector<Contestant> contestants;
    for (const StartCase& c : cases) {
        contestants.push_back(
            {.suite = "start", .scene = c.name, .who = "cold", .run = [&start, &caches, &c] {
                 std::filesystem::remove_all(caches);
                 return start(c);
             }});
        contestants.push_back(
            {.suite = "start", .scene = c.name, .who = "warm", .run = [&start, &c] { return start(c); }});
    }
    run_rounds(contestants, {.rounds = options.rounds, .budget_ms = 6000}, result.figures, options.progress);
}

}  // namespace tarn
