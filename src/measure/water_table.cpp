#include "measure/water_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"

namespace tarn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The worst of several values is the farthest from `ideal`.
struct FigureKind {
    const char* name;
    double ideal;
    bool mean;  // typical is the mean over seeds, else the median
    int decimals;
    bool general;  // of every scenario: what the run cost, and its books
};

constexpr FigureKind kinds[] = {
    {"flat_from_tick", -infinity, false, 0, false},
    {"within_1_vox_from_tick", -infinity, false, 0, false},
    {"drained_from_tick", -infinity, false, 0, false},
    {"at_rest_from_tick", -infinity, false, 0, false},
    {"closed_rest_from_tick", -infinity, false, 0, false},
    {"false_head_vox", -infinity, false, 3, false},
    {"height_sd_vox", -infinity, false, 3, false},
    {"lowest_column_vox", infinity, false, 2, false},
    {"highest_column_vox", -infinity, false, 2, false},
    {"left_above_vox", -infinity, false, 3, false},
    {"arms_differ_vox", -infinity, false, 2, false},
    {"left_arm_vox", -infinity, false, 2, false},
    {"right_arm_vox", -infinity, false, 2, false},
    {"volume_vox", -infinity, false, 2, false},
    {"xx_over_zz", 1, true, 3, false},
    {"axis_over_diagonal", 1, true, 3, false},
    {"d1_over_d2", 1, true, 3, false},
    {"c4", 0, true, 4, false},
    {"sand_over_fluid", -infinity, false, 0, false},
    {"steep_sand_pairs", -infinity, false, 0, false},
    {"sand_peak_vox", -infinity, false, 0, false},
    {"shafts_not_full", -infinity, false, 0, false},
    {"flat_time_exponent", -infinity, false, 2, false},
    {"ticks", -infinity, false, 0, true},
    {"ms_per_tick", -infinity, false, 2, true},
    {"quanta_moved_per_tick", -infinity, false, 0, true},
    {"hanging_cells", -infinity, false, 0, true},
    {"active_bricks", -infinity, false, 0, true},
    {"mass_off", -infinity, false, 0, true},
};

const FigureKind& kind_of(const std::string& figure) {
    const auto* found =
        std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) { return figure == k.name; });
    CHECK_MSG(found != std::end(kinds), "figure {} has no kind", figure);
    return *found;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double worst(const std::vector<double>& values, double ideal) {
    if (std::isinf(ideal))
        return ideal < 0 ? *std::max_element(values.begin(), values.end())
                         : *std::min_element(values.begin(), values.end());
    return *std::max_element(values.begin(), values.end(),
                             [&](double a, double b) { return std::abs(a - ideal) < std::abs(b - ideal); });
}

Verdict verdict_of(const WaterRow& row) {
    if (!row.target) return Verdict::None;
    const bool met = (!row.target->typical || row.target->typical->holds(row.typical)) &&
                     (!row.target->worst || row.target->worst->holds(row.worst));
    if (met) return Verdict::Pass;
    return row.figure == "mass_off" ? Verdict::Bad : Verdict::Miss;
}

void finish(WaterRow& row) {
    const FigureKind& kind = kind_of(row.figure);
    row.average = kind.mean ? "mean" : "median";
    row.typical = kind.mean ? mean(row.values) : median(row.values);
    row.worst = worst(row.values, kind.ideal);
    row.target = water_target(row.tier, row.scenario, row.figure);
    row.verdict = verdict_of(row);
}

// Of bigdam against dam, seed by seed: its basin is 160 long, the dam's 64.
void add_scaling(std::span<const WaterRun> runs, std::vector<WaterRow>& rows) {
    struct Times {
        std::map<std::uint32_t, double> dam, bigdam;
    };
    std::vector<std::pair<std::string, Times>> tiers;
    for (const WaterRun& run : runs) {
        if (run.scenario != "dam" && run.scenario != "bigdam") continue;
        if (tiers.empty() || tiers.back().first != run.tier) tiers.push_back({run.tier, {}});
        Times& times = tiers.back().second;
        for (const Figure& figure : run.figures)
            if (figure.name == "flat_from_tick")
                (run.scenario == "dam" ? times.dam : times.bigdam)[run.seed] = figure.value;
    }
    for (const auto& entry : tiers) {
        const std::string& tier = entry.first;
        const Times& times = entry.second;
        WaterRow row{.tier = tier, .scenario = "bigdam", .figure = "flat_time_exponent"};
        for (const auto& [seed, large] : times.bigdam) {
            const auto small = times.dam.find(seed);
            if (small == times.dam.end() || small->second <= 0) continue;
            // Where neither ends there is nothing to compare.
            if (std::isinf(small->second)) continue;
            row.values.push_back(std::log(large / small->second) / std::log(160.0 / 64.0));
        }
        if (row.values.empty()) continue;
        finish(row);
        const auto same_scenario = [&](const WaterRow& r) {
            return r.tier == tier && r.scenario == "bigdam";
        };
        const auto last = std::find_if(rows.rbegin(), rows.rend(), same_scenario);
        rows.insert(last.base(), row);
    }
}

std::string number(double value, int decimals) {
    return std::isinf(value) ? "never" : fmt::format("{:.{}f}", value, decimals);
}

std::string range_text(const Range& range) {
    if (range.low == range.high) return fmt::format("{:g}", range.low);
    if (std::isinf(range.low)) return fmt::format("<= {:g}", range.high);
    if (std::isinf(range.high)) return fmt::format(">= {:g}", range.low);
    return fmt::format("{:g} to {:g}", range.low, range.high);
}

std::string target_text(const WaterRow& row) {
    if (!row.target) return "";
    const auto& [typical, worst_of] = *row.target;
    std::string text;
    if (typical) text = fmt::format("{} {}", row.average, range_text(*typical));
    if (worst_of) text += fmt::format("{}worst {}", typical ? ", " : "", range_text(*worst_of));
    return text;
}

const char* verdict_text(Verdict verdict) {
    switch (verdict) {
        case Verdict::None:
            return "";
        case Verdict::Pass:
            return "pass";
        case Verdict::Miss:
            return "miss";
        case Verdict::Bad:
            return "BAD";
    }
    CHECK(false);
}

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

// Trailing blanks would be noise in a diff of two tables.
std::string trimmed(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

std::string figures_text(std::span<const WaterRow> rows) {
    std::string text = trimmed(fmt::format("{:<9} {:<23} {:>9} {:>9}  {:<32} {}", "scenario", "figure",
                                           "typical", "worst", "target", ""));
    std::string before;
    for (const WaterRow& row : rows) {
        const FigureKind& kind = kind_of(row.figure);
        if (kind.general) continue;
        text += trimmed(fmt::format("{:<9} {:<23} {:>9} {:>9}  {:<32} {}",
                                    row.scenario == before ? "" : row.scenario, row.figure,
                                    number(row.typical, kind.decimals), number(row.worst, kind.decimals),
                                    target_text(row), verdict_text(row.verdict)));
        before = row.scenario;
    }
    return text;
}

std::string general_text(std::span<const WaterRow> rows) {
    std::string head = fmt::format("{:<9}", "scenario");
    for (const FigureKind& kind : kinds)
        if (kind.general) head += fmt::format(" {:>{}}", kind.name, std::string_view(kind.name).size());
    std::string text = "\n" + head + "\n";
    for (auto row = rows.begin(); row != rows.end();) {
        const std::string& scenario = row->scenario;
        const auto end = std::find_if(row, rows.end(), [&](const auto& r) { return r.scenario != scenario; });
        std::string line = fmt::format("{:<9}", scenario);
        for (const FigureKind& kind : kinds) {
            if (!kind.general) continue;
            const auto cell = std::find_if(row, end, [&](const auto& r) { return r.figure == kind.name; });
            std::string value = "-";
            if (cell != end) value = number(cell->typical, kind.decimals);
            if (cell != end && cell->figure == "mass_off")
                value = cell->verdict == Verdict::Bad ? fmt::format("BAD: {:.0f}", cell->worst) : "exact";
            line += fmt::format(" {:>{}}", value, std::string_view(kind.name).size());
        }
        text += trimmed(line);
        row = end;
    }
    return text;
}

}  // namespace

std::optional<Target> water_target(const std::string& tier, const std::string& scenario,
                                   const std::string& figure) {
    const auto at_most = [](double high) { return Target{.worst = Range{.high = high}}; };
    if (figure == "mass_off") return Target{.worst = Range{0, 0}};
    struct Row {
        const char* scenario;
        const char* figure;
        std::optional<Target> level, pressure;
    };
    const Target axes{.typical = Range{0.97, 1.03}};
    const Target diagonals{.typical = Range{0.94, 1.07}};
    const Row rows[] = {
        {"dam", "flat_from_tick", at_most(200), at_most(200)},
        {"dam", "at_rest_from_tick", Target{Range{.high = 320}, Range{.high = 450}}, at_most(500)},
        {"dam", "height_sd_vox", at_most(0.12), at_most(0.12)},
        {"blob", "at_rest_from_tick", at_most(250), at_most(350)},
        {"spill", "left_above_vox", at_most(0.15), at_most(0.15)},
        {"utube", "within_1_vox_from_tick", {}, at_most(700)},
        {"ulong", "within_1_vox_from_tick", {}, at_most(1000)},
        {"uthin", "within_1_vox_from_tick", {}, at_most(2000)},
        {"riser", "within_1_vox_from_tick", {}, at_most(800)},
        {"tall-arm", "within_1_vox_from_tick", {}, at_most(800)},
        {"tap", "false_head_vox", {}, at_most(0.5)},
        {"point", "xx_over_zz", axes, axes},
        {"point", "axis_over_diagonal", diagonals, diagonals},
        {"sand", "sand_over_fluid", at_most(0), at_most(0)},
        {"sand", "steep_sand_pairs", at_most(0), at_most(0)},
        {"shafts", "shafts_not_full", at_most(0), at_most(0)},
        {"bigdam", "flat_time_exponent", at_most(2), at_most(2)},
    };
    for (const Row& row : rows) {
        if (scenario != row.scenario || figure != row.figure) continue;
        if (tier == "level") return row.level;
        if (tier == "pressure") return row.pressure;
    }
    return std::nullopt;
}

std::vector<WaterRow> water_rows(std::span<const WaterRun> runs) {
    std::vector<WaterRow> rows;
    for (const WaterRun& run : runs)
        for (const Figure& figure : run.figures) {
            const auto same = std::find_if(rows.begin(), rows.end(), [&](const WaterRow& row) {
                return row.tier == run.tier && row.scenario == run.scenario && row.figure == figure.name;
            });
            if (same != rows.end())
                same->values.push_back(figure.value);
            else
                rows.push_back({.tier = run.tier,
                                .scenario = run.scenario,
                                .figure = figure.name,
                                .values = {figure.value}});
        }
    for (WaterRow& row : rows) finish(row);
    add_scaling(runs, rows);
    return rows;
}

bool any_bad(std::span<const WaterRow> rows) {
    return std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.verdict == Verdict::Bad; });
}

std::string water_text(std::span<const WaterRow> rows) {
    std::string text;
    for (auto row = rows.begin(); row != rows.end();) {
        const std::string& tier = row->tier;
        const auto end = std::find_if(row, rows.end(), [&](const auto& r) { return r.tier != tier; });
        const std::size_t seeds = row->values.size();
        text += fmt::format("{}tier {}, {} seed{}\n", text.empty() ? "" : "\n", tier, seeds,
                            seeds == 1 ? "" : "s");
        text += figures_text({row, end}) + general_text({row, end});
        row = end;
    }
    return text;
}

std::string water_csv(std::span<const WaterRow> rows) {
    std::string text = "tier,scenario,figure,average,typical,worst,target,verdict,values\n";
    for (const WaterRow& row : rows) {
        std::vector<std::string> values;
        for (const double value : row.values) values.push_back(fmt::format("{}", value));
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", row.tier, row.scenario, row.figure, row.average,
                            row.typical, row.worst, quoted(target_text(row)), verdict_text(row.verdict),
                            fmt::join(values, " "));
    }
    return text;
}

}  // namespace tarn
