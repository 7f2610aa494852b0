// Medians, spreads and ratios of the benchmark, the turns that its contestants take, and its bars.
#include "bench/figures.h"

#include <gtest/gtest.h>

#include "bench/bars.h"

namespace tarn {
namespace {

std::vector<double> quartered(double a, double b, double c, double d) {
    return {a, b, c, d};
}

TEST(BenchFigures, StatisticsOfKnownSamples) {
    const std::vector<double> odd{5, 1, 3, 2, 4};
    const Statistics five = statistics_of(odd);
    EXPECT_EQ(five.median, 3);
    EXPECT_EQ(five.min, 1);
    EXPECT_EQ(five.max, 5);
    EXPECT_EQ(five.spread, 2.0 / 3);  // quartiles 2 and 4
    const Statistics four = statistics_of(quartered(40, 10, 30, 20));
    EXPECT_EQ(four.median, 25);
    EXPECT_EQ(four.spread, (32.5 - 17.5) / 25);
    const Statistics one = statistics_of(std::vector<double>{7});
    EXPECT_EQ(one.median, 7);
    EXPECT_EQ(one.spread, 0);
    EXPECT_EQ(statistics_of(std::vector<double>{0, 0, 0}).spread, 0);
}

TEST(BenchFigures, RatiosAreTakenRoundByRound) {
    const BenchFigure a{{}, "ms", {2, 2, 6, 6, 6}};
    const BenchFigure b{{}, "ms", {1, 1, 3, 3, 3}};
    EXPECT_EQ(ratio_of(a, b), 2);
    // The machine became three times slower when b had dropped out: the ratio of medians would be 6.
    const BenchFigure short_b{{}, "ms", {1, 1}};
    EXPECT_EQ(ratio_of(a, short_b), 2);
    EXPECT_EQ(ratio_of(short_b, a), 0.5);
}

TEST(BenchFigures, RatesAreBetterWhenHigher) {
    EXPECT_TRUE(more_is_better("Mrays/s"));
    for (const char* unit : {"ms", "s", "MiB", "steps"}) EXPECT_FALSE(more_is_better(unit)) << unit;
}

TEST(BenchFigures, MeansGoOverEnoughRuns) {
    int runs = 0;
    EXPECT_EQ(mean_ms_of_runs(10, [&] { return ++runs; }), 2.5);  // 1 + 2 + 3 + 4
    EXPECT_EQ(runs, 4);
    EXPECT_EQ(mean_ms_of_runs(10, [&] { return 50; }), 50);
}

TEST(BenchFigures, ContestantsTakeTurnsAndTheirFirstRunsDoNotCount) {
    std::string order;
    std::vector<Contestant> contestants;
    for (const char* who : {"a", "b"})
        contestants.push_back(
            {.suite = "s", .scene = "c", .who = who, .run = [&order, who] {
                 order += who;
                 const auto nth = static_cast<double>(order.size());
                 return std::vector<Sample>{{"nth", "runs", nth}, {"twice", "runs", 2 * nth}};
             }});
    std::vector<BenchFigure> figures;
    int told = 0;
    run_rounds(contestants, {.rounds = 3, .budget_ms = 1e9}, figures, [&](const std::string& text) {
        ++told;
        EXPECT_TRUE(text == "s c a" || text == "s c b") << text;
    });
    EXPECT_EQ(order, "abababab");
    EXPECT_EQ(told, 8);
    ASSERT_EQ(figures.size(), 4u);
    EXPECT_EQ(figures[0].samples, (std::vector<double>{3, 5, 7}));
    EXPECT_EQ(find_figure(figures, {"s", "c", "twice", "b"})->samples, (std::vector<double>{8, 12, 16}));
    EXPECT_EQ(find_figure(figures, {"s", "c", "nth", "d"}), nullptr);
}

TEST(BenchFigures, WhoHasUsedUpItsTimeTakesPartNoMore) {
    std::string order;
    std::vector<Contestant> contestants;
    for (const char* who : {"a", "b"})
        contestants.push_back({.suite = "s", .scene = "c", .who = who, .run = [&order, who] {
                                   order += who;
                                   return std::vector<Sample>{{"n", "runs", 1}};
                               }});
    std::vector<BenchFigure> figures;
    run_rounds(contestants, {.rounds = 9, .budget_ms = 0}, figures, [](const std::string&) {});
    EXPECT_EQ(order, "abab");  // one that does not count, one that does
    EXPECT_EQ(figures.at(0).samples.size(), 1u);
}

const BarRow* row_with(const std::vector<BarRow>& rows, const std::string& text) {
    for (const BarRow& row : rows)
        if (row.what.find(text) != std::string::npos) return &row;
    return nullptr;
}

TEST(BenchBars, RatiosStandBesideTheirBars) {
    const std::vector<BenchFigure> figures{
        {{"rays", "terrain-128", "primary", "tarn"}, "Mrays/s", {6, 6, 6}},
        {{"rays", "terrain-128", "primary", "embree-8"}, "Mrays/s", {10, 10, 10}},
        {{"rays", "terrain-512", "primary", "tarn"}, "Mrays/s", {3, 3, 3}},
        {{"frame", "lake", "frame 640x360", "fast"}, "ms", {18}},
        {{"frame", "lake", "primary rays 640x360", "embree-8"}, "ms", {9}},
        {{"sim", "terrain-512", "tick", "awake"}, "ms", {1000}},
        {{"sim", "terrain-512", "tick", "asleep"}, "ms", {4}},
        {{"start", "lake", "first frame", "warm"}, "s", {2.5, 1.5, 3.5}}};
    const std::vector<BarRow> rows = bar_rows(figures);
    const BarRow* packets = row_with(rows, "Embree's packets (primary, terrain-128)");
    ASSERT_NE(packets, nullptr);
    EXPECT_EQ(packets->value, 0.6);
    EXPECT_TRUE(packets->met());
    EXPECT_FALSE(packets->reached());
    const BarRow* size = row_with(rows, "512^3 / 128^3");
    EXPECT_EQ(size->value, 2);  // half the rays: twice the cost
    EXPECT_FALSE(size->met());
    const BarRow* fast = row_with(rows, "frame, fast");
    EXPECT_EQ(fast->value, 2);
    EXPECT_TRUE(fast->reached());
    EXPECT_EQ(row_with(rows, "at rest / all awake")->value, 0.004);
    EXPECT_EQ(row_with(rows, "start to first frame")->value, 2.5);
    EXPECT_FALSE(row_with(rows, "start to first frame")->met());
    const BarRow* cpu = row_with(rows, "CPU on all threads");
    EXPECT_EQ(cpu->value, std::nullopt);
    EXPECT_FALSE(cpu->met());

    const std::string text = bars_text(rows);
    EXPECT_NE(text.find("0.6     >= 0.5       >= 1  met"), std::string::npos) << text;
    EXPECT_NE(text.find("2       <= 4       <= 2  reached"), std::string::npos) << text;
    EXPECT_NE(text.find("not measured"), std::string::npos) << text;
}

}  // namespace
}  // namespace tarn
