// Values of the shipped BSDFs: Fresnel and Snell against double precision, sampling against value and
// density, reciprocity, and every input at its limits.
#include <glm/gtx/string_cast.hpp>

#include "bsdf_case.h"
#include "gl_test.h"
#include "microfacet_energy.h"

namespace tarn {
namespace {

class BsdfValueTest : public GlTest {};

constexpr double float_ulp = 0x1p-23;

TEST_F(BsdfValueTest, FresnelAndSnellAreExactToRounding) {
    std::vector<glm::vec4> inputs;
    for (const double eta : {0.25, 0.5, 1 / 1.5, 0.75, 1 / 1.333, 0.9, 0.99, 0.9999, 1.0, 1.0001, 1.01, 1.1,
                             1.333, 1.5, 2.0, 3.0, 4.0}) {
        for (int i = 0; i <= 4096; ++i) {
            // Crowded at both ends and on both sides of the critical angle.
            const double critical = eta < 1 ? std::sqrt(1 - eta * eta) : 0.5;
            const double x = i / 4096.0;
            for (const double cos_i : {x * x * x, 1 - x * x * x, critical + (1 - critical) * std::pow(x, 6),
                                       critical * (1 - std::pow(x, 6))})
                inputs.emplace_back(std::sqrt(1 - cos_i * cos_i), cos_i, eta, 0);
        }
    }
    gl::Buffer input_buffer("inputs", inputs.size() * sizeof(glm::vec4));
    input_buffer.upload(inputs);
    input_buffer.bind_storage(1);
    const gl::Buffer buffer("results", inputs.size() * sizeof(glm::vec4));
    BsdfKernel kernel("tests/kernels/fresnel.comp");
    kernel.run({}, static_cast<int>(inputs.size()), buffer);
    std::vector<glm::vec4> results(inputs.size());
    buffer.download(std::span(results));
    double worst_reflectance = 0;
    double worst_direction = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec4 in(inputs[i]);
        const glm::dvec4 out(results[i]);
        const double cos_i = in.y;
        const double eta = in.z;
        const double f = eta == 1 ? 0 : exact_fresnel(cos_i, eta);
        // Near the critical angle reflectance moves by much more than the cosine does: that of neighbouring
        // floats.
        const double below = exact_fresnel(cos_i * (1 - 2 * float_ulp), eta);
        const double above = exact_fresnel(std::min(1.0, cos_i * (1 + 2 * float_ulp)), eta);
        worst_reflectance = std::max(worst_reflectance, std::abs(out.x - f) - std::abs(below - above));
        const double g2 = eta * eta - 1 + cos_i * cos_i;
        if (std::abs(g2) < 4 * float_ulp * cos_i * cos_i) continue;  // passes or not by rounding
        EXPECT_EQ(out.w, g2 > 0 ? 1 : 0) << cos_i << " " << eta;
        if (g2 <= 0) continue;
        const double cos_t = std::sqrt(g2) / eta;
        // The root loses what cos^2 and eta^2 - 1 cancel.
        const double allowed = 1 + cos_i * cos_i / (eta * eta * cos_t);
        worst_direction = std::max(
            {worst_direction, std::abs(out.y + in.x / eta) / allowed, std::abs(out.z + cos_t) / allowed});
    }
    EXPECT_LE(worst_reflectance, 8 * float_ulp);
    EXPECT_LE(worst_direction, 4 * float_ulp);
    fmt::print("{} pairs: reflectance within {:.1f} ulp of 1, refracted direction {:.1f}\n", inputs.size(),
               worst_reflectance / float_ulp, worst_direction / float_ulp);
}

// As tests/kernels/bsdf_agreement.comp; the first three in units of rounding.
struct Worst {
    float weight, density, reciprocity, asymmetry;
    std::uint32_t reflected, transmitted, ended, disagree;
};

Worst agreement(BsdfKernel& kernel, const BsdfCase& c) {
    constexpr int invocations = 1024;
    const gl::Buffer buffer("worst", invocations * sizeof(Worst));
    BsdfCaseBlock block = case_block(c, 64);
    block.seed = 5;
    kernel.run(block, invocations, buffer);
    std::vector<Worst> each(invocations);
    buffer.download(std::span(each));
    Worst all{};
    for (const Worst& w : each) {
        all.weight = std::max(all.weight, w.weight);
        all.density = std::max(all.density, w.density);
        all.reciprocity = std::max(all.reciprocity, w.reciprocity);
        all.asymmetry = std::max(all.asymmetry, w.asymmetry);
        all.reflected += w.reflected;
        all.transmitted += w.transmitted;
        all.ended += w.ended;
        all.disagree += w.disagree;
    }
    return all;
}

TEST_F(BsdfValueTest, SamplingAgreesWithValueAndDensityAndBothDirectionsWithEachOther) {
    BsdfKernel kernel("tests/kernels/bsdf_agreement.comp");
    // Roundings in a row that each may be of the size which the kernel estimates.
    constexpr float roundings = 8;
    Worst worst{};
    const auto check = [&](const BsdfCase& c) {
        const Worst w = agreement(kernel, c);
        EXPECT_LE(w.weight, roundings) << c.text();
        EXPECT_LE(w.density, roundings) << c.text();
        EXPECT_LE(w.reciprocity, roundings) << c.text();
        EXPECT_EQ(w.disagree, 0u) << c.text();
        EXPECT_GT(w.reflected + w.transmitted, 40000u) << c.text();
        EXPECT_EQ(w.transmitted > 0, c.transmissive) << c.text();
        worst.weight = std::max(worst.weight, w.weight);
        worst.density = std::max(worst.density, w.density);
        worst.reciprocity = std::max(worst.reciprocity, w.reciprocity);
        return w;
    };
    for (const double alpha : {1e-3, 0.01, 0.1, 0.5, 1.0}) {
        for (const double eta : {0.5, 1 / 1.5, 0.999, 1.0001, 1.01, 1.333, 1.5, 2.5})
            check({.alpha = alpha, .eta = eta, .transmissive = true});
        for (const double eta : {0.75, 1.125, 1.5}) {
            check({.alpha = alpha, .eta = eta});
            check({.alpha = alpha, .eta = eta, .uniform_diffuse = true});
        }
        const Worst metal = check({.alpha = alpha, .metallic = 1, .base = 0.9});
        fmt::print("metal, F0 0.9, alpha {}: f differs backwards by up to {:.0f} %\n", alpha,
                   100 * metal.asymmetry);
    }
    check({.eta = 1});
    check({.eta = 1, .uniform_diffuse = true});
    fmt::print("in units of rounding: weight {:.2f}, density {:.2f}, reciprocity {:.2f}\n", worst.weight,
               worst.density, worst.reciprocity);
}

// As tests/kernels/bsdf_sweep.comp.
struct Faults {
    std::uint32_t samples, values, bad_samples, bad_values;
    glm::vec4 sample_input, value_input;
};

TEST_F(BsdfValueTest, NoInputGivesWhatIsNotFiniteOrNegative) {
    BsdfKernel kernel("tests/kernels/bsdf_sweep.comp");
    constexpr int invocations = 16 * 12;
    std::uint64_t tried = 0;
    for (const double eta :
         {0.25, 0.75, 0.9999, 1 - 6e-8, 1.0, 1 + 1.2e-7, 1.0001, 1.0084, 1.333, 1.5, 4.0}) {
        std::vector<BsdfCase> cases = {{.eta = eta, .transmissive = true}};
        for (const double metallic : {0.0, 0.5, 1.0})
            for (const double base : {0.0, 1e-30, 0.5, 1.0})
                for (const bool uniform : {false, true})
                    cases.push_back(
                        {.eta = eta, .metallic = metallic, .base = base, .uniform_diffuse = uniform});
        for (const BsdfCase& c : cases) {
            const gl::Buffer buffer("faults", invocations * sizeof(Faults));
            kernel.run(case_block(c, 0), invocations, buffer);
            std::vector<Faults> faults(invocations);
            buffer.download(std::span(faults));
            for (const Faults& f : faults) {
                EXPECT_EQ(f.bad_samples, 0u)
                    << c.text() << "; cos, alpha, u: " << glm::to_string(f.sample_input);
                EXPECT_EQ(f.bad_values, 0u)
                    << c.text() << "; cos, alpha, cos and azimuth of wi: " << glm::to_string(f.value_input);
                tried += f.samples + f.values;
            }
        }
    }
    EXPECT_GT(tried, 20000000u);
    fmt::print("{} samples and values\n", tried);
}

}  // namespace
}  // namespace tarn
