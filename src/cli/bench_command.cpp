#include "cli/bench_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <thread>

#include "app/stopwatch.h"
#include "bench/bars.h"
#include "bench/bench_report.h"
#include "bench/bench_suites.h"
#include "bench/embree_scene.h"
#include "cli/names.h"
#include "cli/progress.h"
#include "core/files.h"
#include "gl/context.h"
#include "platform/platform.h"

namespace tarn {

namespace {

struct Suite {
    const char* name;
    void (*run)(const BenchOptions&, BenchResult&);
};
constexpr Suite suites[] = {{"rays", run_rays_suite},   {"frame", run_frame_suite},
                            {"sim", run_sim_suite},     {"edit", run_edit_suite},
                            {"start", run_start_suite}, {"variants", run_variants_suite}};

std::vector<BenchFigure> read_figures(const std::string& path) {
    return read_bench_json(read_text_file(path), path);
}

BenchReport measure(const Arguments& arguments, const std::vector<std::string>& names) {
    BenchReport report;
    report.about = about_machine();
    Settings balanced;
    apply_quality(balanced, Quality::Balanced);
    report.settings_json = settings_json(balanced);
    const auto platform = make_headless({1, 1}, 0);
    const gl::DriverInfo driver = gl::driver_info();
    report.about.emplace_back("driver", driver.renderer);
    report.about.emplace_back("driver_version", driver.version);
    report.about.emplace_back("embree", embree_version());
    report.about.emplace_back("tarn", TARN_VERSION);
    report.about.emplace_back("suites", fmt::format("{}", fmt::join(names, ",")));
    report.about.emplace_back("sizes_vox", fmt::format("{}", fmt::join(arguments.bench_sides_vox, ",")));
    report.about.emplace_back("repeats", fmt::format("{}", arguments.repeats));
    for (const auto& [name, value] : report.about)
        fmt::print("{:<14} {}\n", name, value.empty() ? "none" : value);
    fmt::print("\n");
    std::fflush(stdout);

    BenchResult result;
    StepProgress progress;
    BenchOptions options{.sides_vox = arguments.bench_sides_vox,
                         .rounds = arguments.repeats,
                         .threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency())),
                         .progress = [&](const std::string& what) { progress.show(what); }};
    if (arguments.size_px != glm::ivec2(0)) options.frame_sizes_px = {arguments.size_px};
    for (const Suite& suite : suites) {
        if (std::find(names.begin(), names.end(), suite.name) == names.end()) continue;
        const Stopwatch watch;
        const std::clock_t processors = std::clock();
        suite.run(options, result);
        add_sample(result.figures, {suite.name, "all", "the suite itself", "all"}, "s", watch.ms() / 1e3);
        // All threads of this process: on a busy machine less than its wall clock says.
        add_sample(result.figures, {suite.name, "all", "the suite itself, processor time", "all"}, "s",
                   static_cast<double>(std::clock() - processors) / CLOCKS_PER_SEC);
    }
    report.figures = std::move(result.figures);
    report.notes = std::move(result.notes);
    report.failures = std::move(result.failures);
    return report;
}

}  // namespace

const std::vector<std::string>& bench_suites() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Suite& suite : suites) list.emplace_back(suite.name);
        return list;
    }();
    return names;
}

int run_bench_command(const Arguments& arguments) {
    const auto names = names_of("--suite", arguments.suites, bench_suites());
    std::vector<BenchFigure> before;
    if (!arguments.compare.empty()) before = read_figures(arguments.compare);
    if (!arguments.with.empty()) {
        fmt::print("{}", compare_text(before, read_figures(arguments.with)));
        return 0;
    }
    if (!arguments.out.empty()) make_folder(arguments.out, {"bench.json", "bench.csv"});
    const BenchReport report = measure(arguments, names);
    fmt::print("{}\n", figures_text(report.figures));
    fmt::print("{}", bars_text(bar_rows(report.figures)));
    if (!before.empty()) fmt::print("\n{}", compare_text(before, report.figures));
    for (const std::string& note : report.notes) fmt::print("{}\n", note);
    for (const std::string& failure : report.failures) fmt::print("FAILED {}\n", failure);
    if (!arguments.out.empty()) {
        const std::filesystem::path folder = arguments.out;
        write_file(folder / "bench.json", bench_json(report));
        write_file(folder / "bench.csv", bench_csv(report.figures));
    }
    return report.failures.empty() ? 0 : 1;
}

}  // namespace tarn
