// Figures of the benchmark: the samples of one thing, what they say, and ratios of things that were measured
// in turn. Knows no GL.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tarn {

// What a figure is of. `who`: the contestant or the setting that was measured.
struct FigureKey {
    std::string suite, scene, what, who;
    bool operator==(const FigureKey&) const = default;
};

struct BenchFigure {
    FigureKey key;
    std::string unit;
    std::vector<double> samples;  // in the order of the rounds, never empty
};

struct Statistics {
    double median, min, max;
    double spread;  // between the quartiles, in parts of the median; 0 for one sample
};
Statistics statistics_of(std::span<const double> samples);

// True for units that count work done in a time; false for times, bytes and counts.
bool more_is_better(const std::string& unit);

const BenchFigure* find_figure(std::span<const BenchFigure> figures, const FigureKey& key);

// a over b: the median over the rounds that both took part in of their ratio in that round.
double ratio_of(const BenchFigure& a, const BenchFigure& b);

// The mean of what `run_ms` returns, over as many runs as take `least_ms` by that count: on a busy machine
// short runs slip between the turns of other programs, and would look better than what they are compared
// with.
double mean_ms_of_runs(double least_ms, const std::function<double()>& run_ms);

// One sample of a contestant may hold several figures: a frame and its passes.
struct Sample {
    std::string what, unit;
    double value;
};
struct Contestant {
    std::string suite, scene, who;
    std::function<std::vector<Sample>()> run;
};

struct RoundOptions {
    int rounds = 5;
    // A contestant that has used it up takes part in no further round.
    double budget_ms = 2000;
};

// Runs all in turn, round after round, and adds their figures. The first run of each is not counted: it
// compiles. `progress` is called with the name of who runs next.
void run_rounds(std::vector<Contestant>& contestants, const RoundOptions& options,
                std::vector<BenchFigure>& figures, const std::function<void(const std::string&)>& progress);

// Adds a figure of one sample, or a sample to a figure that is there.
void add_sample(std::vector<BenchFigure>& figures, const FigureKey& key, const std::string& unit,
                double value);

}  // namespace tarn
