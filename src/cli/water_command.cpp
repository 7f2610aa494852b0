#include "cli/water_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "cli/names.h"
#include "cli/progress.h"
#include "core/error.h"
#include "core/files.h"
#include "gl/context.h"
#include "measure/water_speed.h"
#include "measure/water_table.h"
#include "platform/platform.h"

namespace tarn {

namespace {

std::vector<WaterRun> run_all(const Arguments& arguments, const std::vector<std::string>& tiers,
                              const std::vector<std::string>& scenarios, const Settings& settings) {
    const MakeStepper make = arguments.reference ? make_reference_stepper : make_gpu_stepper;
    std::vector<WaterRun> runs;
    for (const std::string& tier : tiers) {
        for (const std::string& name : scenarios) {
            for (int seed = 1; seed <= arguments.seeds; ++seed) {
                const WaterScenario& scenario = *find_water_scenario(name);
                WaterRunOptions options{.stepper = {.settings = settings, .awake = arguments.awake},
                                        .ticks_limit = static_cast<int>(arguments.ticks)};
                set_setting(options.stepper.settings, "water_tier", tier);
                Progress progress(fmt::format("water: {} {} seed {}", tier, name, seed),
                                  static_cast<std::uint64_t>(scenario.ticks_max));
                options.progress = [&](int done) { progress.show(static_cast<std::uint64_t>(done)); };
                runs.push_back(run_water(scenario, static_cast<std::uint32_t>(seed), make, options));
            }
        }
    }
    return runs;
}

}  // namespace

int run_water_command(const Arguments& arguments) {
    std::vector<std::string> all_scenarios;
    for (const WaterScenario& scenario : water_scenarios()) all_scenarios.emplace_back(scenario.name);
    const auto tier_names = choice_names<WaterTier>();
    const auto tiers = names_of("--tier", arguments.tiers, {tier_names.begin(), tier_names.end()});
    const auto scenarios = names_of("--scenario", arguments.scenarios, all_scenarios);
    Settings settings;
    for (const std::string& assignment : arguments.set) set_assignment(settings, assignment);
    if (!arguments.out.empty()) make_folder(arguments.out, {"water.csv", "water.svg"});

    if (arguments.speed && arguments.reference) fail("--speed --reference: choose one; --speed times both");
    const std::unique_ptr<Platform> platform = arguments.reference ? nullptr : make_headless({1, 1}, 0);
    if (arguments.reference)
        fmt::print("stepped by the serial CPU reference\n\n");
    else
        fmt::print("stepped by {}\n\n", gl::driver_info().renderer);
    std::fflush(stdout);

    if (arguments.speed) {
        Progress progress("water: speed", 100);
        const auto rows = measure_water_speed(tiers, arguments.sides_vox, 3, [&](double share) {
            progress.show(static_cast<std::uint64_t>(100 * share));
        });
        fmt::print("{}", speed_text(rows));
        if (!arguments.out.empty())
            write_file(std::filesystem::path(arguments.out) / "water_speed.csv", speed_csv(rows));
        return 0;
    }

    const std::vector<WaterRun> runs = run_all(arguments, tiers, scenarios, settings);
    const std::vector<WaterRow> rows = water_rows(runs);
    fmt::print("{}", water_text(rows));
    if (!arguments.out.empty()) {
        const std::filesystem::path folder = arguments.out;
        write_file(folder / "water.csv", water_csv(rows));
        write_file(folder / "water.svg", water_plot(runs));
    }
    return any_bad(rows) ? 1 : 0;
}

}  // namespace tarn
