// The table of figures: typical and worst over seeds, targets, verdicts, CSV; and the plot's axes.
#include "measure/water_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "measure/svg_plot.h"

namespace tarn {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

WaterRun run(const std::string& tier, const std::string& scenario, std::uint32_t seed,
             std::vector<Figure> figures) {
    return {.tier = tier, .scenario = scenario, .seed = seed, .figures = std::move(figures)};
}

std::vector<WaterRow> rows_of(const std::string& tier, const std::string& scenario, const std::string& figure,
                              const std::vector<double>& values) {
    std::vector<WaterRun> runs;
    runs.reserve(values.size());
    std::uint32_t seed = 1;
    for (const double value : values) runs.push_back(run(tier, scenario, seed++, {{figure, value}}));
    return water_rows(runs);
}

WaterRow row_of(const std::string& tier, const std::string& scenario, const std::string& figure,
                const std::vector<double>& values) {
    const std::vector<WaterRow> rows = rows_of(tier, scenario, figure, values);
    EXPECT_EQ(rows.size(), 1u);
    return rows.front();
}

TEST(WaterTable, TypicalAndWorstOverSeeds) {
    const WaterRow rest = row_of("level", "dam", "at_rest_from_tick", {300, 440, 310, 290, 305});
    EXPECT_EQ(rest.typical, 305);
    EXPECT_EQ(rest.worst, 440);
    EXPECT_EQ(row_of("level", "dam", "at_rest_from_tick", {1, 4, 2, 3}).typical, 2.5);
    EXPECT_EQ(row_of("level", "dam", "at_rest_from_tick", {1, never, 3}).typical, 3);
    EXPECT_EQ(row_of("level", "dam", "at_rest_from_tick", {1, never, 3}).worst, never);
    EXPECT_EQ(row_of("level", "dam", "lowest_column_vox", {11, 12, 10}).worst, 10);
    const WaterRow round = row_of("level", "point", "axis_over_diagonal", {0.9, 1.05, 1.08});
    EXPECT_STREQ(round.average, "mean");
    EXPECT_DOUBLE_EQ(round.typical, 1.01);
    EXPECT_EQ(round.worst, 0.9);
}

TEST(WaterTable, VerdictsFollowTheTargets) {
    const auto verdict = [](const char* tier, const char* scenario, const char* figure,
                            const std::vector<double>& values) {
        return row_of(tier, scenario, figure, values).verdict;
    };
    // median <= 320, worst <= 450
    EXPECT_EQ(verdict("level", "dam", "at_rest_from_tick", {320, 320, 450}), Verdict::Pass);
    EXPECT_EQ(verdict("level", "dam", "at_rest_from_tick", {321, 321, 100}), Verdict::Miss);
    EXPECT_EQ(verdict("level", "dam", "at_rest_from_tick", {300, 300, 451}), Verdict::Miss);
    EXPECT_EQ(verdict("pressure", "dam", "at_rest_from_tick", {321, 500}), Verdict::Pass);
    EXPECT_EQ(verdict("level", "dam", "height_sd_vox", {.1, .121}), Verdict::Miss);
    EXPECT_EQ(verdict("pressure", "utube", "within_1_vox_from_tick", {700}), Verdict::Pass);
    EXPECT_EQ(verdict("pressure", "utube", "within_1_vox_from_tick", {never}), Verdict::Miss);
    EXPECT_EQ(verdict("level", "utube", "within_1_vox_from_tick", {never}), Verdict::None);
    EXPECT_EQ(verdict("block", "dam", "flat_from_tick", {never}), Verdict::None);
    // The mean counts, not a seed that is off.
    EXPECT_EQ(verdict("level", "point", "axis_over_diagonal", {0.9, 1.1}), Verdict::Pass);
    EXPECT_EQ(verdict("level", "point", "xx_over_zz", {1.04}), Verdict::Miss);
    for (const char* tier : {"block", "level", "pressure"}) {
        EXPECT_EQ(verdict(tier, "blob", "mass_off", {0, 0}), Verdict::Pass);
        EXPECT_EQ(verdict(tier, "blob", "mass_off", {0, 0, 0, 1}), Verdict::Bad);
    }
    EXPECT_TRUE(any_bad(rows_of("level", "blob", "mass_off", {0, 1})));
    EXPECT_FALSE(any_bad(rows_of("level", "dam", "flat_from_tick", {never})));
}

TEST(WaterTable, TimeToFlatnessGrowsByAnExponentOfTheLength) {
    std::vector<WaterRun> runs;
    for (std::uint32_t seed = 1; seed <= 2; ++seed) {
        runs.push_back(run("level", "dam", seed, {{"flat_from_tick", 100}}));
        // 2.5^1.5 as long
        runs.push_back(run("level", "bigdam", seed, {{"flat_from_tick", 395.2847075210474}}));
        runs.push_back(run("block", "dam", seed, {{"flat_from_tick", never}}));
        runs.push_back(run("block", "bigdam", seed, {{"flat_from_tick", never}}));
    }
    std::stable_sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.tier < b.tier; });
    const std::vector<WaterRow> rows = water_rows(runs);
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows.back().figure, "flat_time_exponent");
    EXPECT_EQ(rows.back().tier, "level");
    EXPECT_NEAR(rows.back().typical, 1.5, 1e-12);
    EXPECT_EQ(rows.back().verdict, Verdict::Pass);
}

// Fields of a line of RFC 4180.
std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') {
            if (quoted && i + 1 < line.size() && line[i + 1] == '"')
                fields.back() += line[++i];
            else
                quoted = !quoted;
        } else if (line[i] == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += line[i];
        }
    }
    return fields;
}

TEST(WaterTable, CsvGivesBackWhatWentIn) {
    const std::vector<WaterRow> rows = rows_of("level", "dam", "at_rest_from_tick", {300.25, never, 310});
    const std::string csv = water_csv(rows);
    const std::size_t end = csv.find('\n');
    ASSERT_NE(end, std::string::npos);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
    const std::vector<std::string> head = fields_of(csv.substr(0, end));
    const std::vector<std::string> fields = fields_of(csv.substr(end + 1, csv.size() - end - 2));
    ASSERT_EQ(head, (std::vector<std::string>{"tier", "scenario", "figure", "average", "typical", "worst",
                                              "target", "verdict", "values"}));
    ASSERT_EQ(fields.size(), head.size());
    EXPECT_EQ(fields[0], "level");
    EXPECT_EQ(fields[2], "at_rest_from_tick");
    EXPECT_EQ(std::stod(fields[4]), 310);
    EXPECT_EQ(std::stod(fields[5]), never);
    EXPECT_EQ(fields[6], "median <= 320, worst <= 450");
    EXPECT_EQ(fields[7], "miss");
    EXPECT_EQ(fields[8], "300.25 inf 310");
}

TEST(WaterTable, TextShowsTargetsMissesAndBrokenBooks) {
    const std::vector<WaterRun> runs = {
        run("level", "dam", 1, {{"flat_from_tick", never}, {"height_sd_vox", 0.1}, {"mass_off", 2}})};
    const std::string text = water_text(water_rows(runs));
    const auto line_with = [&](const std::string& word) {
        const std::size_t at = text.find(word);
        EXPECT_NE(at, std::string::npos) << word;
        return text.substr(text.rfind('\n', at) + 1, text.find('\n', at) - text.rfind('\n', at) - 1);
    };
    EXPECT_NE(line_with("flat_from_tick").find("never"), std::string::npos);
    EXPECT_NE(line_with("flat_from_tick").find("<= 200"), std::string::npos);
    EXPECT_NE(line_with("flat_from_tick").find("miss"), std::string::npos);
    EXPECT_NE(line_with("height_sd_vox").find("pass"), std::string::npos);
    EXPECT_NE(text.find("BAD: 2"), std::string::npos);
}

TEST(Plot, AxesHaveRoundTicks) {
    EXPECT_EQ(axis_ticks(0.01, 30, true), (std::vector<double>{0.01, 0.1, 1, 10}));
    EXPECT_EQ(axis_ticks(0, 600, false), (std::vector<double>{0, 100, 200, 300, 400, 500, 600}));
    EXPECT_EQ(axis_ticks(0, 2499, false), (std::vector<double>{0, 500, 1000, 1500, 2000}));
    EXPECT_FALSE(std::signbit(axis_ticks(0, 10, false).front()));
}

TEST(Plot, DrawsALinePerTierAndKeepsItSmall) {
    std::vector<WaterRun> runs;
    for (const char* tier : {"block", "level"})
        for (std::uint32_t seed = 1; seed <= 2; ++seed) {
            WaterRun one = run(tier, "dam", seed, {});
            for (int tick = 0; tick < 20000; ++tick)
                one.level_error.push_back({tick, tick % 7 == 0 ? 0.0 : 1.0 / (1 + tick)});
            one.level_axis = "a < b & c";
            one.level_limit = 0.6;
            runs.push_back(one);
        }
    const std::string svg = water_plot(runs);
    const auto count = [&](const std::string& word) {
        int n = 0;
        for (std::size_t at = svg.find(word); at != std::string::npos; at = svg.find(word, at + 1)) ++n;
        return n;
    };
    EXPECT_EQ(count("<polyline"), 2);
    EXPECT_EQ(count(">dam</text>"), 1);
    EXPECT_EQ(count("a &lt; b &amp; c"), 1);
    EXPECT_EQ(count("nan") + count("inf"), 0);
    EXPECT_LT(svg.size(), 60000u);
}

}  // namespace
}  // namespace tarn
