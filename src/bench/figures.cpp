#include "bench/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/stopwatch.h"
#include "core/error.h"

namespace tarn {

namespace {

constexpr int runs_of_a_mean_max = 10000;

// Between the samples by linear interpolation; `sorted` is not empty.
double quantile(const std::vector<double>& sorted, double part) {
    const double at = part * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

}  // namespace

Statistics statistics_of(std::span<const double> samples) {
    CHECK(!samples.empty());
    std::vector<double> sorted(samples.begin(), samples.end());
    std::sort(sorted.begin(), sorted.end());
    const double median = quantile(sorted, 0.5);
    const double between = quantile(sorted, 0.75) - quantile(sorted, 0.25);
    return {.median = median,
            .min = sorted.front(),
            .max = sorted.back(),
            .spread = median != 0 ? between / std::abs(median) : 0};
}

bool more_is_better(const std::string& unit) {
    return unit.ends_with("/s");
}

const BenchFigure* find_figure(std::span<const BenchFigure> figures, const FigureKey& key) {
    const auto found =
        std::find_if(figures.begin(), figures.end(), [&](const BenchFigure& f) { return f.key == key; });
    return found == figures.end() ? nullptr : &*found;
}

double ratio_of(const BenchFigure& a, const BenchFigure& b) {
    const std::size_t rounds = std::min(a.samples.size(), b.samples.size());
    std::vector<double> ratios;
    for (std::size_t i = 0; i < rounds; ++i) ratios.push_back(a.samples[i] / b.samples[i]);
    return statistics_of(ratios).median;
}

double mean_ms_of_runs(double least_ms, const std::function<double()>& run_ms) {
    double sum_ms = 0;
    int runs = 0;
    do {
        sum_ms += run_ms();
        ++runs;
    } while (sum_ms < least_ms && runs < runs_of_a_mean_max);
    return sum_ms / runs;
}

void add_sample(std::vector<BenchFigure>& figures, const FigureKey& key, const std::string& unit,
                double value) {
    const auto found =
        std::find_if(figures.begin(), figures.end(), [&](const BenchFigure& f) { return f.key == key; });
    if (found != figures.end())
        found->samples.push_back(value);
    else
        figures.push_back({key, unit, {value}});
}

void run_rounds(std::vector<Contestant>& contestants, const RoundOptions& options,
                std::vector<BenchFigure>& figures, const std::function<void(const std::string&)>& progress) {
    const auto show = [&](const Contestant& c) {
        progress(fmt::format("{} {} {}", c.suite, c.scene, c.who));
    };
    for (const Contestant& c : contestants) {
        show(c);
        c.run();
    }
    std::vector<double> used_ms(contestants.size(), 0);
    for (int round = 0; round < options.rounds; ++round) {
        for (std::size_t i = 0; i < contestants.size(); ++i) {
            if (round > 0 && used_ms[i] >= options.budget_ms) continue;
            const Contestant& c = contestants[i];
            show(c);
            const Stopwatch watch;
            for (const Sample& sample : c.run())
                add_sample(figures, {c.suite, c.scene, sample.what, c.who}, sample.unit, sample.value);
            used_ms[i] += watch.ms();
        }
    }
}

}  // namespace tarn
