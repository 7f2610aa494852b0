// The shipped GLSL of random numbers and scattering, in small kernels, against double-precision quadrature.
#include <array>
#include <cmath>
#include <numbers>

#include "app/albedo_textures.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl_test.h"
#include "reference/albedo.h"
#include "shared/bindings.h"

namespace tarn {
namespace {

class BsdfTest : public GlTest {};

gl::Program kernel(const char* path) {
    return gl::Program({.label = path, .compute = path, .vertex = {}, .fragment = {}, .defines = {}});
}

TEST_F(BsdfTest, Fault4_RandomFloatsAreNeverOne) {
    struct Result {
        float largest_possible;
        std::uint32_t at_one, stuck;
        std::array<std::uint32_t, 16> histogram;
    } result{};
    const gl::Program program = kernel("tests/kernels/rng.comp");
    const gl::Buffer buffer("result", sizeof(Result));
    buffer.bind_storage(0);
    constexpr std::uint32_t count = 1 << 16;
    program.set("count", count);
    program.dispatch_for({count, 1, 1}, {64, 1, 1});
    buffer.download(std::span(&result, 1));
    EXPECT_EQ(result.largest_possible, 1 - std::ldexp(1.0f, -24));
    EXPECT_EQ(result.at_one, 0u);
    EXPECT_EQ(result.stuck, 0u);
    // 2^20 floats in 16 bins: five standard deviations of a bin are 1.9 %.
    for (const std::uint32_t bin : result.histogram) EXPECT_NEAR(bin, count, 0.02 * count);
}

TEST_F(BsdfTest, Fault4_ASeedThatHashesToZeroDoesNotStick) {
    std::array<std::uint32_t, 2> result{};
    const gl::Program program = kernel("tests/kernels/seed.comp");
    const gl::Buffer buffer("result", sizeof(result));
    buffer.bind_storage(0);
    program.dispatch({1, 1, 1});
    buffer.download(std::span<std::uint32_t>(result));
    EXPECT_EQ(result[0], 1u) << "the test's own seed must hash to zero";
    EXPECT_EQ(result[1], 0u);
}

TEST_F(BsdfTest, SequencesSpreadEvenlyAndEachOfTheirPathsIsUnbiased) {
    struct Result {
        std::array<std::uint32_t, 16> histogram{};
        std::uint32_t products = 0, least = 64, most = 0;
        std::array<std::uint32_t, 2> least_pairs{16, 16}, most_pairs{};
    };
    const gl::Program program = kernel("tests/kernels/rng_sequence.comp");
    gl::Buffer buffer("result", sizeof(Result));
    buffer.bind_storage(0);
    constexpr std::uint32_t count = 1 << 16;
    program.set("count", count);
    for (const std::uint32_t path : {0u, 1u, 37u, 63u}) {
        Result result;
        buffer.upload(std::span(&result, 1));
        program.set("looked_at", path);
        program.dispatch_for({count, 1, 1}, {64, 1, 1});
        buffer.download(std::span(&result, 1));
        // 4096 expected: five standard deviations are 320.
        for (const std::uint32_t bin : result.histogram) EXPECT_NEAR(bin, count / 16.0, 320) << path;
        // Of independent numbers 255.5; five standard deviations are 4.4.
        EXPECT_NEAR(static_cast<double>(result.products) / count, 255.5, 4.4) << path;
        // 4 expected; of 64 independent numbers some pixel has none and some pixel 15 in a bin.
        EXPECT_GE(result.least, 2u);
        EXPECT_LE(result.most, 6u);
        // 4 expected; with steps that suit consecutive paths alone some pixel has none, and 10.
        for (const int stride : {0, 1}) {
            EXPECT_GE(result.least_pairs[stride], 1u) << stride;
            EXPECT_LE(result.most_pairs[stride], 7u) << stride;
        }
    }
}

struct Means {
    double weight = 0, error = 0, not_finite = 0;
    glm::dvec3 dir{0};  // mean of weight * wi
};

struct Case {
    double cos_o, alpha, metallic, base, eta;
};

Means sample_means(const Case& c) {
    struct Sums {
        glm::vec4 weight_dir, squares;
    };
    constexpr int invocations = 4096;
    constexpr int each = 64;
    const gl::Program program = kernel("tests/kernels/bsdf.comp");
    const gl::Buffer buffer("sums", invocations * sizeof(Sums));
    const AlbedoTextures albedo = make_albedo_textures();
    albedo.dielectric.bind(BINDING_ALBEDO_TABLE);
    albedo.metal.bind(BINDING_METAL_ALBEDO_TABLE);
    buffer.bind_storage(0);
    program.set("wo", glm::vec3(std::sqrt(1 - c.cos_o * c.cos_o), 0, c.cos_o));
    program.set("alpha", static_cast<float>(c.alpha));
    program.set("metallic", static_cast<float>(c.metallic));
    program.set("base", static_cast<float>(c.base));
    program.set("eta", static_cast<float>(c.eta));
    program.set("per_invocation", static_cast<std::uint32_t>(each));
    program.dispatch_for({invocations, 1, 1}, {64, 1, 1});
    std::vector<Sums> sums(invocations);
    buffer.download(std::span(sums));
    Means means;
    double squares = 0;
    constexpr double n = 1.0 * invocations * each;
    for (const Sums& s : sums) {
        means.dir += glm::dvec3(s.weight_dir) / n;
        means.weight += s.weight_dir.w / n;
        squares += s.squares.x / n;
        means.not_finite += s.squares.y;
    }
    means.error = std::sqrt(std::max(0.0, squares - means.weight * means.weight) / n);
    return means;
}

// The same by a grid over directions: GGX with Smith's height-correlated term, and Schlick's F of f0 = 1,
// which is 1.
Means metal_quadrature(double cos_o, double alpha) {
    const glm::dvec3 wo(std::sqrt(1 - cos_o * cos_o), 0, cos_o);
    const auto lambda = [&](const glm::dvec3& w) {
        return (std::sqrt(1 + alpha * alpha * (w.x * w.x + w.y * w.y) / (w.z * w.z)) - 1) / 2;
    };
    Means means;
    constexpr int rows = 1200;
    constexpr int columns = 1200;
    for (int i = 0; i < rows; ++i) {
        const double z = (i + 0.5) / rows;
        for (int j = 0; j < columns; ++j) {
            const double phi = 2 * std::numbers::pi * (j + 0.5) / columns;
            const glm::dvec3 wi(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi),
                                z);
            const glm::dvec3 h = glm::normalize(wo + wi);
            const double s = h.z * h.z * (alpha * alpha - 1) + 1;
            const double d = alpha * alpha / (std::numbers::pi * s * s);
            const double f_cos = d / ((1 + lambda(wo) + lambda(wi)) * 4 * cos_o);
            const double area = 2 * std::numbers::pi / (1.0 * rows * columns);
            means.weight += f_cos * area;
            means.dir += wi * (f_cos * area);
        }
    }
    return means;
}

TEST_F(BsdfTest, Fault3_GgxReflectsAboutItsNormalWithItsWeight) {
    for (const double alpha : {0.1, 0.3, 1.0}) {
        for (const double cos_o : {0.2, 0.7, 0.99}) {
            const Means sampled = sample_means({cos_o, alpha, 1, 1, 1.5});
            const Means expected = metal_quadrature(cos_o, alpha);
            // Turquin's, for F0 = 1: what scatters more than once goes where the rest goes.
            const double gain = 1 / expected.weight;
            const double tolerance = 5 * sampled.error + 0.001;
            EXPECT_NEAR(sampled.weight, expected.weight * gain, tolerance) << alpha << " " << cos_o;
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(sampled.dir[k], expected.dir[k] * gain, 5e-3)
                    << alpha << " " << cos_o << " axis " << k;
            EXPECT_EQ(sampled.not_finite, 0);
        }
    }
}

TEST_F(BsdfTest, ABlackCoatedSurfaceReflectsTheAlbedoOfItsInterface) {
    for (const double alpha : {0.0, 0.05, 0.3, 1.0}) {
        for (const double cos_o : {0.1, 0.5, 1.0}) {
            const Means sampled = sample_means({cos_o, alpha, 0, 0, 1.5});
            const double expected = ggx_dielectric_albedo(cos_o, alpha, 1.5, 200);
            EXPECT_NEAR(sampled.weight, expected, 5 * sampled.error + 0.001) << alpha << " " << cos_o;
        }
    }
}

TEST_F(BsdfTest, ExtremesGiveFiniteWeights) {
    for (const double alpha : {0.0, 1e-8, 9.9e-4, 1e-3, 1.0}) {
        for (const double cos_o : {1e-6, 1e-3, 1.0}) {
            for (const double eta : {0.75, 1.0, 1.0001, 1.013, 1.5, 4.0}) {
                for (const double metallic : {0.0, 0.5, 1.0}) {
                    const Means sampled = sample_means({cos_o, alpha, metallic, 0.8, eta});
                    EXPECT_EQ(sampled.not_finite, 0)
                        << alpha << " " << cos_o << " " << eta << " " << metallic;
                    // At grazing angles albedo jumps from 0 to 1 as eta leaves 1; the table follows to this.
                    const double gain = 0.02;
                    EXPECT_LT(sampled.weight, 1 + 5 * sampled.error + gain)
                        << alpha << " " << cos_o << " " << eta << " " << metallic;
                }
            }
        }
    }
}

}  // namespace
}  // namespace tarn
