// The measured trade without a GPU: errors against sampled references, the space and its search, the table.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "measure/picture_error.h"
#include "measure/tradeoff_space.h"
#include "measure/tradeoff_table.h"

namespace tarn {
namespace {

constexpr std::size_t pixels = 20000;

// Pixels of truth 1 + i % 3 with noise and an offset.
Luminance picture(double noise, double offset, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Luminance y(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        y[i] = static_cast<float>(1.0 + static_cast<double>(i % 3) + offset + noise * normal(random));
    return y;
}

// mean of e^2 / (truth^2 + 0.01 * 4)
double relative(double squared) {
    return squared * (1 / 1.04 + 1 / 4.04 + 1 / 9.04) / 3;
}

TEST(PictureError, IsThatOfThePictureAloneHoweverNoisyItsReference) {
    for (const double reference_noise : {0.0, 0.02, 0.04}) {
        const Reference reference{picture(reference_noise, 0, 1), picture(reference_noise, 0, 2), 1};
        const Luminance x = picture(0.05, 0.1, 3);
        const Luminance y = picture(0.05, 0.1, 4);
        EXPECT_NEAR(error_of(x, reference), relative(0.0125), 0.05 * relative(0.0125)) << reference_noise;
        EXPECT_NEAR(bias_of(x, y, reference), relative(0.01), 0.05 * relative(0.01)) << reference_noise;
        // Of the mean of two halves.
        EXPECT_NEAR(floor_of(reference), relative(reference_noise * reference_noise / 2),
                    0.05 * relative(reference_noise * reference_noise / 2) + 1e-12);
    }
}

TEST(TradeoffSpace, CoordinatesAreWhatQualitiesSetAndHaveValuesThatSettingsTake) {
    const auto keys = preset_keys();
    for (const Coordinate& coordinate : tradeoff_coordinates()) {
        EXPECT_NE(std::find(keys.begin(), keys.end(), coordinate.key), keys.end()) << coordinate.key;
        for (const char* value : coordinate.values) {
            Settings settings;
            set_setting(settings, coordinate.key, value);
            EXPECT_EQ(setting_text(settings, *find_setting(coordinate.key)), value) << coordinate.key;
        }
    }
}

TEST(TradeoffSpace, TextAndLabelsNameWhatDiffers) {
    Configuration c = configuration_of(Quality::Balanced);
    EXPECT_EQ(label_of(c), "balanced");
    EXPECT_EQ(parse_configuration(text_of(c)), c);
    Settings settings;
    apply(c, settings);
    settings.history_cap = 96;
    c = configuration_of(settings);
    EXPECT_EQ(label_of(c), "balanced history_cap=96");
    EXPECT_EQ(parse_configuration(text_of(c)), c);
    EXPECT_THROW(parse_configuration("history_cap=none"), Error);
}

TEST(TradeoffSpace, NeighboursDifferInOneThingThatMatters) {
    const Configuration c = configuration_of(Quality::Balanced);
    const auto neighbours = neighbours_of(c);
    EXPECT_GT(neighbours.size(), 20u);
    for (const Configuration& n : neighbours) {
        EXPECT_FALSE(n == c);
        EXPECT_EQ(nearest_quality(n).differs.size(), 1u) << text_of(n);
    }
    Settings without;
    apply(c, without);
    without.history = History::None;
    without.filter = Filter::None;
    for (const Configuration& n : neighbours_of(configuration_of(without)))
        for (const std::string& assignment : nearest_quality(n).differs) {
            EXPECT_EQ(assignment.find("history_cap"), std::string::npos) << assignment;
            EXPECT_EQ(assignment.find("filter_passes"), std::string::npos) << assignment;
        }
}

Measured at(double time, double error, bool eligible = true) {
    return {configuration_of(Quality::Balanced), time, error, eligible};
}

TEST(TradeoffSpace, TheFrontHoldsWhatNothingEligibleBeats) {
    const std::vector<Measured> all = {at(3, 1),     at(1, 4), at(2, 2),
                                       at(2.5, 2.5), at(2, 3), at(0.5, 0.1, false)};
    EXPECT_EQ(pareto_front(all), (std::vector<std::size_t>{1, 2, 0}));
}

// Time and error of a made-up trade, best at 4 samples and a cap of 256 or more.
Measured made_up(const Configuration& c) {
    Settings s;
    apply(c, s);
    const double samples = s.samples_per_pixel;
    const double scale = s.resolution_scale;
    const double cap = s.history == History::Count ? s.history_cap : 1;
    const double time =
        samples * scale * scale + 0.1 * s.max_diffuse_bounces + (s.traversal == Traversal::Voxel ? 1 : 0);
    return {c, time, 1 / samples / cap + 0.1 / (1 + s.max_diffuse_bounces) + 0.05 / scale};
}

TEST(CoordinateSearch, KeepsItsBudgetMeasuresNothingTwiceAndImproves) {
    const std::vector<Configuration> starts = {configuration_of(Quality::Balanced),
                                               configuration_of(Quality::Fast),
                                               configuration_of(Quality::Quality)};
    for (const int budget : {1, 3, 10, 150}) {
        CoordinateSearch search(starts, budget);
        for (auto batch = search.next(); !batch.empty(); batch = search.next()) {
            std::vector<Measured> measured;
            measured.reserve(batch.size());
            for (const Configuration& c : batch) measured.push_back(made_up(c));
            search.report(measured);
        }
        const auto& measured = search.measured();
        EXPECT_LE(static_cast<int>(measured.size()), budget);
        if (budget <= 10) {
            EXPECT_EQ(static_cast<int>(measured.size()), budget);
        }
        for (std::size_t i = 0; i < measured.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_NE(measured[i].configuration, measured[j].configuration);
        if (budget < 150) continue;
        // It finds caps beyond those of the starts, and no point of its front steps through every voxel.
        bool long_history = false;
        for (const std::size_t i : pareto_front(measured)) {
            const std::string text = text_of(measured[i].configuration);
            EXPECT_EQ(text.find("traversal=voxel"), std::string::npos);
            long_history |= text.find("history_cap=256") != std::string::npos;
        }
        EXPECT_TRUE(long_history);
    }
}

TEST(CoordinateSearch, GoesAlongOneCoordinateAfterTheOtherFromEveryStart) {
    const std::vector<Configuration> starts = {configuration_of(Quality::Balanced),
                                               configuration_of(Quality::Fast),
                                               configuration_of(Quality::Quality)};
    CoordinateSearch search(starts, 100);
    const auto report = [&](const std::vector<Configuration>& batch) {
        std::vector<Measured> measured(batch.size());
        std::transform(batch.begin(), batch.end(), measured.begin(), made_up);
        search.report(measured);
    };
    report(search.next());
    for (const std::string key : {"resolution_scale", "samples_per_pixel"}) {
        const auto batch = search.next();
        for (const Configuration& start : starts)
            EXPECT_TRUE(std::any_of(batch.begin(), batch.end(), [&](const Configuration& c) {
                Settings moved, from;
                apply(c, moved);
                apply(start, from);
                const SettingInfo& info = *find_setting(key);
                if (info.get(moved) == info.get(from)) return false;
                info.set(moved, info.get(from));
                return configuration_of(moved) == start;
            })) << key;
        report(batch);
    }
}

TradeoffRow row(const Configuration& c, double ratio, double error, double bias,
                const char* recording = "still") {
    return {.program = "p1",
            .scene = "lake",
            .recording = recording,
            .configuration = c,
            .time_ms = 100 * ratio,
            .time_ratio = ratio,
            .error = error,
            .bias = bias,
            .floor = 1e-4,
            .reference_samples = 64,
            .rejected = 0};
}

TEST(TradeoffTable, CsvIsReadBackButForOtherProgramsAndTornLines) {
    const TradeoffRow one = row(configuration_of(Quality::Fast), 0.25, 0.1, 0.05);
    TradeoffRow other = one;
    other.program = "p2";
    const std::string line = tradeoff_csv_line(one);
    const std::string text =
        tradeoff_csv_head() + tradeoff_csv_line(other) + line + line.substr(0, line.size() / 2);
    int others = 0;
    const auto rows = read_tradeoff_csv(text, "t.csv", "p1", others);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(others, 1);
    EXPECT_EQ(tradeoff_csv_line(rows[0]), line);
    EXPECT_EQ(read_tradeoff_csv(tradeoff_csv_head() + line + tradeoff_csv_line(other), "t.csv", "", others)
                  .at(0)
                  .program,
              "p2");
    EXPECT_THROW(read_tradeoff_csv("a,b\n1,2\n", "t.csv", "p1", others), Error);
    EXPECT_TRUE(read_tradeoff_csv("", "t.csv", "p1", others).empty());
}

TEST(TradeoffTable, BarsCompareAtEqualTimeAndAtEqualError) {
    // baseline: noise 0.8 at one sample in a time of 2, bias 0.02.
    std::vector<TradeoffRow> rows;
    for (const int n : baseline_samples) rows.push_back(row(baseline_with(n), 2.0 * n, 0.02 + 0.8 / n, 0.02));
    rows.push_back(row(configuration_of(Quality::Balanced), 1, 0.12, 0.01));
    auto bars = tradeoff_bars(rows);
    ASSERT_EQ(bars.size(), 1u);
    EXPECT_TRUE(bars[0].at_least);
    EXPECT_NEAR(bars[0].error_ratio, 0.82 / 0.12, 1e-9);
    ASSERT_TRUE(bars[0].baseline_ms);
    EXPECT_NEAR(*bars[0].baseline_ms, 100 * 2 * 0.8 / 0.1, 200);  // 8 samples, between two measured
    EXPECT_FALSE(bars[0].extrapolated);
    // Slower than baseline: it may take as many samples as fit.
    rows.back() = row(configuration_of(Quality::Balanced), 8, 0.021, 0.01);
    bars = tradeoff_bars(rows);
    EXPECT_FALSE(bars[0].at_least);
    EXPECT_NEAR(bars[0].baseline_error, 0.22, 1e-9);
    ASSERT_TRUE(bars[0].baseline_ms);
    EXPECT_TRUE(bars[0].extrapolated);
    EXPECT_NEAR(*bars[0].baseline_ms, 100 * 2 * 0.8 / 0.001, 1);
    // Below its bias it never comes.
    rows.back() = row(configuration_of(Quality::Balanced), 1, 0.019, 0.01);
    bars = tradeoff_bars(rows);
    EXPECT_FALSE(bars[0].baseline_ms);
    EXPECT_EQ(bars[0].baseline_floor, 0.02);
    EXPECT_NE(bars_text(bars).find("never"), std::string::npos);
}

TEST(TradeoffTable, ARowNearItsFloorChoosesNothing) {
    std::vector<TradeoffRow> rows = {row(configuration_of(Quality::Fast), 0.25, 0.1, 0.05),
                                     row(configuration_of(Quality::Balanced), 1, 2.9e-4, 0.01),
                                     row(configuration_of(Quality::Quality), 2, 3.1e-4, 0.01)};
    auto points = front_points(rows, 12);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].quality, Quality::Fast);
    EXPECT_EQ(points[1].quality, Quality::Quality);
    // A point beats quality by more than a tenth in both.
    Configuration better = configuration_of(Quality::Quality);
    Settings s;
    apply(better, s);
    s.samples_per_pixel = 1;
    rows.push_back(row(configuration_of(s), 1.5, 3.05e-4, 0.01));
    EXPECT_TRUE(beaten_qualities(rows).empty());
    rows.back().error = 2.8e-4;
    rows.back().floor = 1e-5;
    EXPECT_EQ(beaten_qualities(rows).size(), 2u);  // over all, and in its place
}

TEST(TradeoffTable, TheSliderKeepsEndsQualitiesAndWideSteps) {
    std::vector<TradeoffRow> rows;
    Settings s;
    apply_quality(s, Quality::Balanced);
    for (int i = 0; i < 40; ++i) {
        s.history_cap = 100 + i;
        rows.push_back(row(configuration_of(s), 0.5 * std::pow(1.05, i), 1.0 / (1 + i), 0));
    }
    // Times come in units of what is balanced now.
    const double unit = 0.5 * std::pow(1.05, 20.5);
    rows.push_back(row(configuration_of(Quality::Balanced), unit, 1.0 / 21.5, 0));
    const auto points = front_points(rows, 8);
    ASSERT_EQ(points.size(), 8u);
    EXPECT_DOUBLE_EQ(points.front().time, 0.5 / unit);
    EXPECT_DOUBLE_EQ(points.back().time, rows[39].time_ratio / unit);
    EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const FrontPoint& p) { return p.set.empty(); }),
              1);
    for (std::size_t i = 1; i < points.size(); ++i) EXPECT_GT(points[i].time / points[i - 1].time, 1.1);
}

}  // namespace
}  // namespace tarn
