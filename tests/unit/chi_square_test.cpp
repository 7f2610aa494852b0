// The chi-square test that GPU tests use, against tables and against counts that are wrong on purpose.
#include "chi_square.h"

#include <gtest/gtest.h>

#include <random>

namespace tarn {
namespace {

TEST(ChiSquare, IncompleteGammaHasItsClosedForms) {
    for (const double x : {1e-3, 0.5, 1.0, 3.0, 40.0}) {
        // Rounding of exp and of the sums: some ulps.
        EXPECT_NEAR(upper_gamma(1, x), std::exp(-x), 1e-14);
        EXPECT_NEAR(upper_gamma(2, x), (1 + x) * std::exp(-x), 1e-14);
        EXPECT_NEAR(upper_gamma(0.5, x), std::erfc(std::sqrt(x)), 1e-14);
    }
    EXPECT_EQ(upper_gamma(3, 0), 1);
    // Continuous where the series hands over to the fraction.
    EXPECT_NEAR(upper_gamma(6000, std::nextafter(6001.0, 0)), upper_gamma(6000, 6001), 1e-10);
}

TEST(ChiSquare, QuantilesAreThoseOfTables) {
    // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.4: three decimals.
    EXPECT_NEAR(upper_gamma(0.5, 3.841 / 2), 0.05, 1e-4);
    EXPECT_NEAR(upper_gamma(5, 23.209 / 2), 0.01, 1e-5);
    EXPECT_NEAR(upper_gamma(50, 149.449 / 2), 0.001, 1e-6);
}

TEST(ChiSquare, SidakLevelsMultiplyToTheWhole) {
    EXPECT_EQ(sidak(0.01, 1), 0.01);
    // pow() multiplies an ulp of its base by 80.
    EXPECT_NEAR(1 - std::pow(1 - sidak(0.01, 80), 80), 0.01, 2e-14);
}

// Counts of `n` throws at bins of these probabilities.
std::vector<std::uint32_t> throws(const std::vector<double>& probability, int n) {
    std::mt19937 random(7);
    std::discrete_distribution<std::size_t> pick(probability.begin(), probability.end());
    std::vector<std::uint32_t> counts(probability.size());
    for (int i = 0; i < n; ++i) ++counts[pick(random)];
    return counts;
}

TEST(ChiSquare, AcceptsWhatIsRightAndRejectsWhatIsNot) {
    constexpr int n = 100000;
    std::vector<double> probability(100);
    std::vector<double> expected(100);
    for (int i = 0; i < 100; ++i) probability[i] = (i + 1) / 5050.0;
    for (int i = 0; i < 100; ++i) expected[i] = n * probability[i];
    std::vector<std::uint32_t> observed = throws(probability, n);
    const ChiSquare right = chi_square(expected, observed);
    EXPECT_EQ(right.freedom, 99);
    EXPECT_GT(right.probability, 0.001);
    EXPECT_LT(right.probability, 0.999);
    // 2 % of all counts moved from the upper half to the lower.
    for (int i = 50; i < 100; ++i) {
        const std::uint32_t moved = observed[i] / 50;
        observed[i] -= moved;
        observed[99 - i] += moved;
    }
    EXPECT_LT(chi_square(expected, observed).probability, 1e-6);
}

TEST(ChiSquare, SmallBinsArePooledAndNoneIsForgotten) {
    const std::vector<double> expected = {0, 1, 2, 3, 94};
    const ChiSquare right = chi_square(expected, std::vector<std::uint32_t>{0, 1, 2, 3, 94});
    EXPECT_EQ(right.freedom, 1);  // 0 + 1 + 2 + 3, 94
    EXPECT_EQ(right.statistic, 0);
    // A count where none is expected falls into the pool.
    EXPECT_NEAR(chi_square(expected, std::vector<std::uint32_t>{20, 1, 2, 3, 74}).statistic,
                400 / 6.0 + 400 / 94.0, 1e-12);
    // What is left of the pool joins the last bin.
    EXPECT_EQ(chi_square(std::vector<double>{3, 4, 4}, std::vector<std::uint32_t>{11, 0, 0}).freedom, 0);
}

}  // namespace
}  // namespace tarn
