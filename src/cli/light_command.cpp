#include "cli/light_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "cli/names.h"
#include "cli/progress.h"
#include "core/error.h"
#include "core/files.h"
#include "gl/context.h"
#include "measure/light_table.h"
#include "platform/platform.h"

namespace tarn {

namespace {

// One in 16,000 right means is further off.
constexpr double off_by_max = 4;

// What would make the table mean something else.
void check_assignment(const std::string& assignment) {
    Settings trial;
    set_assignment(trial, assignment);
    const std::string key = assignment.substr(0, assignment.find('='));
    bool taken = key == "view" || key == "history" || key == "quality";
    for (const LightScenario& scenario : light_scenarios()) taken |= is_set_by(scenario, key);
    if (taken)
        fail("--set {}: the strategies that are compared set this; allowed: any other setting", assignment);
}

}  // namespace

int run_light_command(const Arguments& arguments) {
    std::vector<std::string> all;
    for (const LightScenario& scenario : light_scenarios()) all.emplace_back(scenario.name);
    const auto names = names_of("--scenario", arguments.scenarios, all);
    for (const std::string& assignment : arguments.set) check_assignment(assignment);
    if (!arguments.out.empty()) make_folder(arguments.out, {"light.csv"});
    const auto platform = make_headless({1, 1}, 0);
    fmt::print("rendered by {}\n\n", gl::driver_info().renderer);
    std::fflush(stdout);

    std::vector<LightRow> rows;
    for (const LightScenario& scenario : light_scenarios()) {
        if (std::find(names.begin(), names.end(), scenario.name) == names.end()) continue;
        Progress progress(fmt::format("light: {}", scenario.name), 100);
        const auto measured = measure_light(
            scenario, {.rounds = arguments.rounds, .samples = arguments.spp_of_round, .set = arguments.set},
            [&](double share) { progress.show(static_cast<std::uint64_t>(100 * share)); });
        rows.insert(rows.end(), measured.begin(), measured.end());
    }
    fmt::print("{}", light_text(rows));
    if (!arguments.out.empty())
        write_file(std::filesystem::path(arguments.out) / "light.csv", light_csv(rows));
    const bool bad = std::any_of(rows.begin(), rows.end(), [](const LightRow& row) {
        return row.rejected > 0 || std::abs(row.off_by) > off_by_max;
    });
    return bad ? 1 : 0;
}

}  // namespace tarn
