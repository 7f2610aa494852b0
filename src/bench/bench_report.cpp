#include "bench/bench_report.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/bars.h"
#include "core/error.h"

namespace tarn {

namespace {

using nlohmann::ordered_json;

constexpr int format_version = 1;

// The value behind `name` in a file of lines "name : value"; "" where there is none.
std::string line_value(const char* path, const std::string& name) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(name)) continue;
        const std::size_t value = line.find_first_not_of(" \t", line.find(':') + 1);
        return value == std::string::npos ? "" : line.substr(value);
    }
    return "";
}

// Ratios within a run hold less of what else the machine did than its times.
std::string compare_bars(const std::vector<BarRow>& before, const std::vector<BarRow>& now) {
    std::string text;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (!before[i].value || !now[i].value) continue;
        if (text.empty())
            text = fmt::format("\n{:<66} {:>9} {:>9} {:>8}\n", "bar: a ratio within each run", "old", "new",
                               "new/old");
        text += fmt::format("{:<66} {:>9.4g} {:>9.4g} {:>8.3f}\n", now[i].what, *before[i].value,
                            *now[i].value, *now[i].value / *before[i].value);
    }
    return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> about_machine() {
    utsname system{};
    uname(&system);
    std::string load;
    std::getline(std::ifstream("/proc/loadavg"), load);
    return {{"cpu", line_value("/proc/cpuinfo", "model name")},
            {"threads", fmt::format("{}", std::thread::hardware_concurrency())},
            {"memory", line_value("/proc/meminfo", "MemTotal")},
            {"load_at_start", load.substr(0, load.find(' '))},
            {"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)},
            {"compiler", __VERSION__}};
}

std::string figures_text(std::span<const BenchFigure> figures) {
    std::string text =
        fmt::format("{:<8} {:<12} {:<30} {:<10} {:>9} {:>11} {:>11} {:>11} {:>7} {:>4}\n", "suite", "scene",
                    "what", "who", "unit", "median", "min", "max", "spread", "n");
    for (const BenchFigure& f : figures) {
        const Statistics s = statistics_of(f.samples);
        text +=
            fmt::format("{:<8} {:<12} {:<30} {:<10} {:>9} {:>11.5g} {:>11.5g} {:>11.5g} {:>6.1f}% {:>4}\n",
                        f.key.suite, f.key.scene, f.key.what, f.key.who, f.unit, s.median, s.min, s.max,
                        100 * s.spread, f.samples.size());
    }
    return text;
}

std::string bench_csv(std::span<const BenchFigure> figures) {
    std::string text = "suite,scene,what,who,unit,median,min,max,spread,samples\n";
    for (const BenchFigure& f : figures) {
        const Statistics s = statistics_of(f.samples);
        text += fmt::format("{},{},\"{}\",{},{},{},{},{},{},{}\n", f.key.suite, f.key.scene, f.key.what,
                            f.key.who, f.unit, s.median, s.min, s.max, s.spread, f.samples.size());
    }
    return text;
}

std::string bench_json(const BenchReport& report) {
    ordered_json json;
    json["tarn_bench"] = format_version;
    for (const auto& [name, value] : report.about) json["about"][name] = value;
    json["settings"] = ordered_json::parse(report.settings_json);
    json["notes"] = report.notes;
    json["failures"] = report.failures;
    json["bars"] = ordered_json::array();
    for (const BarRow& row : bar_rows(report.figures))
        if (row.value)
            json["bars"].push_back({{"what", row.what},
                                    {"value", *row.value},
                                    {"at_least", row.at_least},
                                    {"reach_for", row.reach_for},
                                    {"more_is_better", row.more_is_better}});
    json["figures"] = ordered_json::array();
    for (const BenchFigure& f : report.figures) {
        const Statistics s = statistics_of(f.samples);
        json["figures"].push_back({{"suite", f.key.suite},
                                   {"scene", f.key.scene},
                                   {"what", f.key.what},
                                   {"who", f.key.who},
                                   {"unit", f.unit},
                                   {"median", s.median},
                                   {"min", s.min},
                                   {"max", s.max},
                                   {"spread", s.spread},
                                   {"samples", f.samples}});
    }
    return json.dump(1) + "\n";
}

std::vector<BenchFigure> read_bench_json(const std::string& text, const std::string& origin) {
    std::vector<BenchFigure> figures;
    try {
        const auto json = nlohmann::json::parse(text);
        if (json.at("tarn_bench") != format_version)
            fail("{}: format {} of the benchmark; this program reads {}", origin, json["tarn_bench"].dump(),
                 format_version);
        for (const auto& f : json.at("figures")) {
            figures.push_back({{f.at("suite"), f.at("scene"), f.at("what"), f.at("who")},
                               f.at("unit"),
                               f.at("samples").get<std::vector<double>>()});
            if (figures.back().samples.empty()) fail("{}: a figure without samples", origin);
        }
    } catch (const nlohmann::json::exception& error) {
        fail("{}: not a bench.json of `tarn bench`: {}", origin, error.what());
    }
    return figures;
}

std::string compare_text(std::span<const BenchFigure> before, std::span<const BenchFigure> now) {
    std::string text = fmt::format("{:<8} {:<12} {:<30} {:<10} {:>9} {:>11} {:>11} {:>8}  {}\n", "suite",
                                   "scene", "what", "who", "unit", "old", "new", "new/old", "samples apart");
    std::size_t shared = 0;
    for (const BenchFigure& f : now) {
        const BenchFigure* const old = find_figure(before, f.key);
        if (old == nullptr || old->unit != f.unit) continue;
        ++shared;
        const Statistics a = statistics_of(old->samples);
        const Statistics b = statistics_of(f.samples);
        // Disjoint samples: what noise of this size would seldom do.
        const bool rose = b.min > a.max;
        const bool fell = b.max < a.min;
        const bool better = more_is_better(f.unit) ? rose : fell;
        const char* verdict = !rose && !fell ? "" : better ? "better" : "worse";
        text += fmt::format("{:<8} {:<12} {:<30} {:<10} {:>9} {:>11.5g} {:>11.5g} {:>8}  {}\n", f.key.suite,
                            f.key.scene, f.key.what, f.key.who, f.unit, a.median, b.median,
                            a.median != 0 ? fmt::format("{:.3f}", b.median / a.median) : std::string("-"),
                            verdict);
    }
    if (shared == 0) return "no figure is in both runs\n";
    text += fmt::format("{} figures in both, {} only in the old, {} only in the new run\n", shared,
                        before.size() - shared, now.size() - shared);
    return text + compare_bars(bar_rows(before), bar_rows(now));
}

}  // namespace tarn
