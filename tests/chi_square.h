// Pearson's chi-square test of counts against their expectations, in double precision.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace tarn {

// The regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0: by its series below the mean, by
// its continued fraction (modified Lentz) above (Press et al. 2007, 6.2).
inline double upper_gamma(double a, double x) {
    if (x <= 0) return 1;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    constexpr double precision = 1e-15;
    constexpr int terms_max = 1000000;
    if (x < a + 1) {
        double term = 1 / a;
        double sum = term;
        for (int n = 1; n < terms_max && term > sum * precision; ++n) {
            term *= x / (a + n);
            sum += term;
        }
        return 1 - front * sum;
    }
    constexpr double tiny = 1e-300;
    double b = x + 1 - a;
    double c = 1 / tiny;
    double d = 1 / b;
    double fraction = d;
    for (int n = 1; n < terms_max; ++n) {
        const double numerator = n * (a - n);
        b += 2;
        d = numerator * d + b;
        c = b + numerator / c;
        d = 1 / (std::abs(d) < tiny ? tiny : d);
        c = std::abs(c) < tiny ? tiny : c;
        fraction *= d * c;
        if (std::abs(d * c - 1) < precision) break;
    }
    return front * fraction;
}

struct ChiSquare {
    double statistic = 0;
    int freedom = 0;         // bins after pooling, less one
    double probability = 1;  // of a statistic as large by chance
};

// Bins are pooled from the smallest expectation up until each expects 5 (Cochran's rule). Counts and
// expectations have the same sum.
inline ChiSquare chi_square(std::span<const double> expected, std::span<const std::uint32_t> observed) {
    constexpr double least = 5;
    std::vector<std::pair<double, double>> bins;
    for (std::size_t i = 0; i < expected.size(); ++i) bins.emplace_back(expected[i], observed[i]);
    // By expectation alone: pooling must not know the counts.
    std::ranges::stable_sort(bins, {}, [](const auto& bin) { return bin.first; });
    std::vector<std::pair<double, double>> pooled;
    std::pair<double, double> pool{0, 0};
    for (const auto& [e, o] : bins) {
        pool = {pool.first + e, pool.second + o};
        if (pool.first < least) continue;
        pooled.push_back(pool);
        pool = {0, 0};
    }
    if (pooled.empty()) return {};
    pooled.back().first += pool.first;
    pooled.back().second += pool.second;
    ChiSquare result;
    for (const auto& [e, o] : pooled) result.statistic += (o - e) * (o - e) / e;
    result.freedom = static_cast<int>(pooled.size()) - 1;
    if (result.freedom > 0) result.probability = upper_gamma(0.5 * result.freedom, 0.5 * result.statistic);
    return result;
}

// The level of each of `tests` tests that together reject what is right with probability `level` (Sidak
// 1967).
inline double sidak(double level, std::size_t tests) {
    return -std::expm1(std::log1p(-level) / static_cast<double>(tests));
}

}  // namespace tarn
