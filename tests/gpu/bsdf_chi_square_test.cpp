// Sampled directions against the density that the shaders report: chi-square over bins of direction, a
// million samples a case.
#include <numeric>
#include <optional>

#include "bsdf_case.h"
#include "chi_square.h"
#include "gl_test.h"

namespace tarn {
namespace {

// As tests/kernels/direction_bins.glsl.
constexpr int rows = 80;
constexpr int columns = 160;
constexpr int rest = 2 * rows * columns;

constexpr int invocations = 4096;
constexpr int per_invocation = 256;
constexpr double samples = 1.0 * invocations * per_invocation;
constexpr double level = 0.01;
constexpr int points = 8;  // along each side of a bin, for the density's integral

// Half vectors of lobes narrower than this are binned by their slopes over alpha: in solid angle one bin
// would hold them.
constexpr double alpha_by_slopes = 0.1;

std::vector<BsdfCase> all_cases() {
    std::vector<BsdfCase> cases;
    for (const bool uniform : {false, true}) {
        cases.push_back({.cos_o = 0.5, .eta = 1, .uniform_diffuse = uniform});
        cases.push_back({.cos_o = 0.5, .alpha = 0.3, .uniform_diffuse = uniform});
    }
    // Coats, towards air and under water.
    for (const double cos_o : {1.0, 0.6, 0.1}) {
        for (const double alpha : {1e-3, 0.02, 0.1, 0.3, 1.0})
            cases.push_back({.cos_o = cos_o, .alpha = alpha});
        for (const double eta : {1.125, 0.75}) cases.push_back({.cos_o = cos_o, .alpha = 0.2, .eta = eta});
    }
    for (const double cos_o : {1.0, 0.8, 0.3, 0.05}) {
        for (const double alpha : {1e-3, 0.01, 0.05, 0.1, 0.3, 1.0})
            cases.push_back({.cos_o = cos_o, .alpha = alpha, .metallic = 1});
        cases.push_back({.cos_o = cos_o, .alpha = 0.2, .eta = 1, .metallic = 0.5});
    }
    for (const double cos_o : {1.0, 0.6, 0.1}) {
        for (const double eta : {1.5, 1 / 1.5})
            for (const double alpha : {1e-3, 0.01, 0.05, 0.1, 0.3, 1.0})
                cases.push_back({.cos_o = cos_o, .alpha = alpha, .eta = eta, .transmissive = true});
        for (const double eta : {1.333, 1 / 1.333})
            cases.push_back({.cos_o = cos_o, .alpha = 0.5, .eta = eta, .transmissive = true});
    }
    return cases;
}

class BsdfChiSquareTest : public GlTest {
  protected:
    struct Result {
        ChiSquare test;
        double mass = 0;  // the integral of the density over the bins
    };

    // Directions sampled of `sampled` against the density of `claimed`.
    Result compare(const BsdfCase& sampled, const BsdfCase& claimed) {
        // Half vectors of rough glass spread little in its refracted lobe: by slopes at any alpha.
        const bool slopes = sampled.transmissive || (sampled.alpha < alpha_by_slopes && sampled.eta != 1);
        const auto block_of = [&](const BsdfCase& c, int count) {
            BsdfCaseBlock block = case_block(c, count);
            block.seed = ++seed_;
            block.by_slopes = slopes ? 1 : 0;
            block.bin_alpha = static_cast<float>(sampled.alpha);
            block.bin_eta = static_cast<float>(sampled.eta);
            return block;
        };
        const gl::Buffer count_buffer("counts", (rest + 1) * sizeof(std::uint32_t));
        histogram_.run(block_of(sampled, per_invocation), invocations, count_buffer);
        std::vector<std::uint32_t> counts(rest + 1);
        count_buffer.download(std::span(counts));

        const gl::Buffer mass_buffer("mass", (rest + 1) * sizeof(float));
        mass_.run(block_of(claimed, points), rest, mass_buffer);
        std::vector<float> mass(rest + 1);
        mass_buffer.download(std::span(mass));

        Result result;
        std::vector<double> expected(rest + 1);
        for (int bin = 0; bin < rest; ++bin) {
            expected[bin] = samples * static_cast<double>(mass[bin]);
            result.mass += static_cast<double>(mass[bin]);
        }
        expected[rest] = samples * std::max(0.0, 1 - result.mass);
        EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0.0), samples);
        result.test = chi_square(expected, counts);
        return result;
    }

  private:
    BsdfKernel histogram_{"tests/kernels/bsdf_histogram.comp"};
    BsdfKernel mass_{"tests/kernels/bsdf_bin_mass.comp"};
    std::uint32_t seed_ = 0;
};

TEST_F(BsdfChiSquareTest, DirectionsAreSampledByTheDensityThatIsReported) {
    const std::vector<BsdfCase> cases = all_cases();
    const double least = sidak(level, cases.size());
    double smallest = 1;
    double largest_mass = 0;
    for (const BsdfCase& c : cases) {
        const Result result = compare(c, c);
        EXPECT_GT(result.test.freedom, 1000) << c.text();
        EXPECT_GT(result.test.probability, least)
            << c.text() << ": chi-square " << result.test.statistic << " of " << result.test.freedom;
        smallest = std::min(smallest, result.test.probability);
        largest_mass = std::max(largest_mass, result.mass);
    }
    // A density holds 1 at most; the sum of midpoints rounds.
    EXPECT_LE(largest_mass, 1 + 1e-5);
    fmt::print("{} cases, smallest probability {:.2g}, level of each {:.2g}, largest mass {:.6f}\n",
               cases.size(), smallest, least, largest_mass);
}

TEST_F(BsdfChiSquareTest, ADensityThatIsALittleOffIsRejected) {
    const auto probability = [&](const BsdfCase& sampled, const auto& change) {
        BsdfCase claimed = sampled;
        change(claimed);
        return compare(sampled, claimed).test.probability;
    };
    const auto rougher = [](double by) { return [by](BsdfCase& c) { c.alpha *= by; }; };
    const auto denser = [](double by) { return [by](BsdfCase& c) { c.eta *= by; }; };
    constexpr double certain = 1e-6;
    for (const double alpha : {0.01, 0.3}) {
        EXPECT_LT(probability({.cos_o = 0.6, .alpha = alpha, .metallic = 1}, rougher(1.03)), certain);
        const BsdfCase glass{.cos_o = 0.6, .alpha = alpha, .transmissive = true};
        EXPECT_LT(probability(glass, rougher(1.03)), certain);
        EXPECT_LT(probability(glass, denser(1.02)), certain);
        // A coat takes a fifth of the samples, and its index only shifts how many.
        const BsdfCase coat{.cos_o = 0.3, .alpha = alpha};
        EXPECT_LT(probability(coat, rougher(1.15)), certain);
        EXPECT_LT(probability(coat, denser(1.2)), certain);
        EXPECT_LT(probability(coat, [](BsdfCase& c) { c.base *= 1.4; }), certain);
    }
    EXPECT_LT(probability({.cos_o = 0.5, .eta = 1}, [](BsdfCase& c) { c.uniform_diffuse = true; }), certain);
}

}  // namespace
}  // namespace tarn
