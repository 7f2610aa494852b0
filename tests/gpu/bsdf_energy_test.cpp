// Energy of the shipped BSDFs: white furnaces, and directional albedo against quadrature in double precision.
#include "bsdf_case.h"
#include "microfacet_energy.h"
#include "picture.h"

namespace tarn {
namespace {

struct Furnace {
    double reflected = 0, transmitted = 0, largest_weight = 0, not_finite = 0;
    double all() const { return reflected + transmitted; }
};

class BsdfEnergyTest : public GlTest {
  protected:
    // By 1024 x `count` samples.
    Furnace furnace(const BsdfCase& c, int count) {
        constexpr int invocations = 1024;
        const gl::Buffer buffer("sums", invocations * sizeof(glm::vec4));
        kernel_.run(case_block(c, count), invocations, buffer);
        std::vector<glm::vec4> sums(invocations);
        buffer.download(std::span(sums));
        Furnace result;
        for (const glm::vec4 s : sums) {
            result.reflected += static_cast<double>(s.x) / (1.0 * invocations * count);
            result.transmitted += static_cast<double>(s.y) / (1.0 * invocations * count);
            result.largest_weight = std::max(result.largest_weight, static_cast<double>(s.z));
            result.not_finite += static_cast<double>(s.w);
        }
        EXPECT_EQ(result.not_finite, 0) << c.text();
        return result;
    }

  private:
    BsdfKernel kernel_{"tests/kernels/bsdf_furnace.comp"};
};

// 0.17 % is the interpolation of the table of metals (src/reference/albedo.h).
constexpr double metal_tolerance = 0.002;
// A quarter of a million points of a lattice, and a choice of the lobe that cuts through it.
constexpr double glass_tolerance = 0.002;

TEST_F(BsdfEnergyTest, AWhiteMetalReturnsAllLightAtEveryRoughnessAndAngle) {
    double worst = 0;
    for (const double alpha : {0.0, 1e-3, 2e-3, 0.01, 0.03, 0.1, 0.25, 0.5, 1.0}) {
        for (const double cos_o : {1e-3, 0.01, 0.03, 0.1, 0.3, 0.6, 0.9, 1.0}) {
            const BsdfCase c{.cos_o = cos_o, .alpha = alpha, .metallic = 1, .base = 1};
            const Furnace f = furnace(c, 32);
            EXPECT_NEAR(f.reflected, 1, metal_tolerance) << c.text();
            EXPECT_EQ(f.transmitted, 0) << c.text();
            worst = std::max(worst, std::abs(f.reflected - 1));
        }
    }
    fmt::print("white metal: furnace within {:.2f} %\n", 100 * worst);
}

TEST_F(BsdfEnergyTest, ColouredMetalsReturnWhatTheirFacetsDoTimesTheCompensation) {
    double largest = 0;
    for (const double f0 : {0.04, 0.5, 0.9}) {
        for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
            for (const double cos_o : {0.01, 0.1, 0.6, 1.0}) {
                const BsdfCase c{.cos_o = cos_o, .alpha = alpha, .metallic = 1, .base = f0};
                const double once = metal_energy(cos_o, alpha, f0).reflected;
                const double white = metal_energy(cos_o, alpha, 1).reflected;
                const double expected = once * (1 + f0 * (1 / white - 1));
                const double returned = furnace(c, 32).reflected;
                EXPECT_NEAR(returned, expected, metal_tolerance) << c.text();
                EXPECT_LT(returned, 1 + metal_tolerance) << c.text();
                largest = std::max(largest, expected / once);
            }
        }
    }
    EXPECT_GT(largest, 2) << "nothing to compensate";
}

TEST_F(BsdfEnergyTest, WhiteAndSmoothSurfacesReturnAllLight) {
    for (const double cos_o : {1e-3, 0.1, 0.6, 1.0}) {
        const BsdfCase lambert{.cos_o = cos_o, .eta = 1, .base = 1};
        EXPECT_EQ(furnace(lambert, 4).reflected, 1) << cos_o;
        BsdfCase uniform = lambert;
        uniform.uniform_diffuse = true;
        // The mean of 2 cos over the lattice.
        EXPECT_NEAR(furnace(uniform, 256).reflected, 1, 1e-4) << cos_o;
        for (const double eta : {0.75, 1 / 1.5, 1.0, 1.0001, 1.333, 3.0}) {
            const BsdfCase clear{.cos_o = cos_o, .alpha = 0, .eta = eta, .transmissive = true};
            // The index squared, divided out and in again: an ulp.
            EXPECT_NEAR(furnace(clear, 4).all(), 1, 2e-7) << clear.text();
        }
        // No interface, whatever its roughness.
        const BsdfCase none{.cos_o = cos_o, .alpha = 0.5, .eta = 1, .transmissive = true};
        EXPECT_EQ(furnace(none, 4).transmitted, 1) << cos_o;
    }
}

TEST_F(BsdfEnergyTest, AWhiteCoatedSurfaceReturnsAllLight) {
    // What the interpolated albedo of the coat allows, by index: barely refracting coats bend most, and for
    // an index below that of the medium total reflection sets in at once.
    struct Allowed {
        double eta, least, most;
    };
    for (const Allowed& allowed : {Allowed{0.75, 0.93, 1.015},
                                   {0.9, 0.96, 1.015},
                                   {1.0001, 0.99, 1.015},
                                   {1.01, 0.994, 1.006},
                                   {1.125, 0.996, 1.005},
                                   {1.333, 0.996, 1.005},
                                   {1.5, 0.996, 1.005},
                                   {2.5, 0.996, 1.005},
                                   {3, 0.996, 1.005}}) {
        double least = 1;
        double most = 1;
        for (const double alpha : {0.0, 1e-3, 1.5e-3, 2e-3, 5e-3, 0.01, 0.03, 0.1, 0.3, 1.0}) {
            for (const double cos_o : {1e-3, 3e-3, 0.01, 0.02, 0.05, 0.1, 0.3, 0.6, 0.7, 1.0}) {
                const BsdfCase c{.cos_o = cos_o, .alpha = alpha, .eta = allowed.eta, .base = 1};
                const double returned = furnace(c, 32).reflected;
                EXPECT_GT(returned, allowed.least) << c.text();
                EXPECT_LT(returned, allowed.most) << c.text();
                least = std::min(least, returned);
                most = std::max(most, returned);
            }
        }
        fmt::print("white coat, eta {}: returns {:.4f} to {:.4f}\n", allowed.eta, least, most);
    }
}

TEST_F(BsdfEnergyTest, RoughGlassSharesAllLightAsItsFacetsDo) {
    double worst = 0;
    double worst_near_one = 0;
    for (const double eta : {0.5, 1 / 1.5, 1 / 1.333, 0.99, 0.9999, 1.0001, 1.01, 1.125, 1.333, 1.5, 2.5}) {
        const bool near_one = std::abs(eta - 1) < 0.1;
        for (const double alpha : {1e-3, 5e-3, 0.03, 0.1, 0.3, 1.0}) {
            for (const double cos_o : {0.01, 0.1, 0.4, 0.75, 1.0}) {
                const BsdfCase c{.cos_o = cos_o, .alpha = alpha, .eta = eta, .transmissive = true};
                const Furnace f = furnace(c, 256);
                const Energy once = glass_energy(cos_o, alpha, eta, 200);
                const double share = once.reflected / (once.reflected + once.transmitted);
                EXPECT_NEAR(f.reflected / f.all(), share, glass_tolerance) << c.text();
                // The interpolation of the table: near grazing it bends as eta leaves 1.
                EXPECT_NEAR(f.all(), 1, near_one ? 0.06 : 0.01) << c.text();
                double& most = near_one ? worst_near_one : worst;
                most = std::max(most, std::abs(f.all() - 1));
            }
        }
    }
    fmt::print("rough glass: furnace within {:.1f} %; within 10 % of index 1: {:.1f} %\n", 100 * worst,
               100 * worst_near_one);
}

// Mean over light from all sides, by cosine.
template <typename Returned>
double mean_over_sides(Returned returned) {
    constexpr int n = 16;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += returned(std::sqrt((i + 0.5) / n)) / n;
    return sum;
}

TEST_F(BsdfEnergyTest, RoughGlassReturnsInTheMeanWhatItsFacetsWouldLose) {
    for (const double eta : {1.5, 1 / 1.5}) {
        double last = 0;
        for (const double alpha : {0.1, 0.25, 0.5, 1.0}) {
            const double lost = 1 - mean_over_sides([&](double cos_o) {
                                    const Energy once = glass_energy(cos_o, alpha, eta, 200);
                                    return once.reflected + once.transmitted;
                                });
            const double returned = mean_over_sides([&](double cos_o) {
                return furnace({.cos_o = cos_o, .alpha = alpha, .eta = eta, .transmissive = true}, 64).all();
            });
            EXPECT_NEAR(returned, 1, 0.005) << eta << " " << alpha;
            EXPECT_GT(lost, last) << "rougher glass scatters more than once more often";
            last = lost;
            fmt::print(
                "rough glass, eta {:.3f}, alpha {:.2f}: {:.1f} % scatters more than once; returns {:.4f}\n",
                eta, alpha, 100 * lost, returned);
        }
    }
}

// A ball of a material in white light from everywhere.
Scene ball(std::uint8_t material, float roughness) {
    Scene scene = scene_from(R"({"size": [24, 24, 24],
        "camera": {"position_vox": [12, 14, 40], "pitch_deg": -5, "fov_deg": 40}, "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]},
        "materials": {"metal": {"base_color": [1, 1, 1], "metallic": 1}, "glass": {"absorption_per_m": [0, 0, 0]}},
        "build": [{"sphere": {"center": [12, 12, 12], "radius": 9, "material": "metal"}}]})");
    for (std::uint8_t& cell : scene.cells.bytes())
        if (cell == MATERIAL_METAL) cell = material;
    scene.materials[material].roughness = roughness;
    return scene;
}

TEST_F(BsdfEnergyTest, AWhiteMetalBallVanishesInAWhiteSky) {
    for (const float roughness : {0.0f, 0.04f, 0.2f, 0.5f, 0.7f, 1.0f}) {
        for (const LightSampling sampling : {LightSampling::None, LightSampling::All}) {
            const Picture picture =
                picture_of(ball(MATERIAL_METAL, roughness), 96, {48, 48}, [&](Settings& s) {
                    s.roulette_after = 1024;
                    s.light_sampling = sampling;
                });
            // Voxels shine on each other: several scatterings, each with the error of the table.
            EXPECT_NEAR(picture.mean().x, 1, 0.01) << roughness;
            EXPECT_LT(picture.standard_error(), 0.0035) << roughness;
            EXPECT_EQ(picture.rejected, 0u);
            fmt::print("white metal ball, roughness {:.2f}, {}: {:.4f} of the sky, error {:.4f}\n", roughness,
                       sampling == LightSampling::None ? "sky by chance" : "sky sampled", picture.mean().x,
                       picture.standard_error());
        }
    }
}

TEST_F(BsdfEnergyTest, AClearGlassBallVanishesInAWhiteSky) {
    for (const float roughness : {0.0f, 0.1f, 0.3162f, 0.5f, 0.7071f, 1.0f}) {
        const Picture picture = picture_of(ball(MATERIAL_GLASS, roughness), 96, {48, 48},
                                           [](Settings& s) { s.roulette_after = 1024; });
        if (roughness == 0) {
            EXPECT_LT(picture.worst(1), 2e-5);
        }
        // Light crosses several interfaces, each with the error of the table.
        EXPECT_NEAR(picture.mean().x, 1, 0.01) << roughness;
        EXPECT_LT(picture.standard_error(), 0.005) << roughness;
        EXPECT_EQ(picture.rejected, 0u);
        fmt::print("clear glass ball, alpha {:.2f}: {:.4f} of the sky, error {:.4f}\n", roughness * roughness,
                   picture.mean().x, picture.standard_error());
    }
}

}  // namespace
}  // namespace tarn
