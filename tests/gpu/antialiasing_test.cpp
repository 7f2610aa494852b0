// Edges smoothed after the fact: how much of a pixel each surface covers, what stays as it was, what never
// appears.
#include "studio.h"

namespace tarn {
namespace {

class AntialiasingTest : public GlTest {};

constexpr glm::ivec2 size_px{64, 36};

// A tower on a floor, each surface of one light: red the floor, green the tower's sides, blue its top. No
// noise.
Scene tower() {
    Scene scene = plain_scene(R"({"size": [128, 16, 128],
        "camera": {"position_vox": [94, 14, 96], "yaw_deg": -41, "pitch_deg": -26, "fov_deg": 24},
        "sun": {"irradiance": [0, 0, 0]},
        "materials": {"stone": {"base_color": [0, 0, 0], "emission": [1, 0, 0]},
                      "wall": {"base_color": [0, 0, 0], "emission": [0, 1, 0]},
                      "dirt": {"base_color": [0, 0, 0], "emission": [0, 0, 1]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [128, 1, 128], "material": "stone"}},
                  {"box": {"min": [76, 1, 78], "max": [82, 5, 84], "material": "wall"}},
                  {"box": {"min": [76, 5, 78], "max": [82, 6, 84], "material": "dirt"}}]})");
    scene.settings.max_bounces = 0;
    return scene;
}

// What each surface covers of each pixel: the mean of 16 x 16 rays.
Picture exact_coverage() {
    constexpr int side = 16;
    Studio studio(tower());
    const Picture fine = studio.shoot(size_px * side);
    Picture coverage{.image = {size_px.x, size_px.y, {}}};
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            glm::dvec3 sum(0);
            for (int i = 0; i < side * side; ++i) sum += fine.at(side * x + i % side, side * y + i / side);
            for (int c = 0; c < 3; ++c)
                coverage.image.pixels.push_back(static_cast<float>(sum[c] / (side * side)));
        }
    return coverage;
}

struct Difference {
    double square = 0, worst = 0;  // mean of the squares over pixels on edges; largest
    glm::dvec3 mean{0};            // signed
};

Difference difference(const Picture& picture, const Picture& coverage) {
    Difference d;
    int edges = 0;
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            const glm::dvec3 exact = coverage.at(x, y);
            if (std::max({exact.x, exact.y, exact.z}) == 1) continue;
            const glm::dvec3 apart = picture.at(x, y) - exact;
            ++edges;
            d.mean += apart;
            d.square += glm::dot(apart, apart) / 3;
            d.worst = std::max({d.worst, std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)});
        }
    EXPECT_GT(edges, 60);
    d.mean /= edges;
    d.square /= edges;
    return d;
}

TEST_F(AntialiasingTest, FacesCoverWhatTheyCoverOfAPixel) {
    const Picture coverage = exact_coverage();
    const auto shot = [&](int samples) {
        Studio studio(tower());
        studio.settings().antialiasing = samples;
        return difference(studio.shoot(size_px), coverage);
    };
    // Of the rays through the centres alone: 0.048. A lattice of n points errs by some 1 / n.
    EXPECT_GT(shot(0).square, 0.04);
    struct Limit {
        int samples;
        double square, worst;
    };
    for (const Limit limit : {Limit{2, 0.021, 0.45}, {4, 0.0095, 0.35}, {8, 0.006, 0.3}}) {
        const Difference d = shot(limit.samples);
        EXPECT_LT(d.square, limit.square) << limit.samples;
        EXPECT_LT(d.worst, limit.worst) << limit.samples;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(d.mean[c], 0, 0.015) << limit.samples << " " << c;
    }
}

TEST_F(AntialiasingTest, APictureWithoutEdgesStaysAsItIsToTheBit) {
    for (const History history : {History::None, History::Count}) {
        Studio plain(noisy_floor());
        Studio smooth(noisy_floor());
        for (Studio* studio : {&plain, &smooth}) {
            studio->settings().history = history;
            studio->settings().filter = Filter::EdgeAware;
        }
        smooth.settings().antialiasing = 4;
        for (int frame = 0; frame < 3; ++frame) {
            const Picture a = plain.shoot({48, 27});
            EXPECT_EQ(a.image.pixels, smooth.shoot({48, 27}).image.pixels) << frame;
            EXPECT_GT(a.standard_error(), 0);
        }
    }
}

TEST_F(AntialiasingTest, EdgesStayPutUnderAStillEye) {
    Studio studio(tower());
    studio.settings().history = History::Count;
    studio.settings().antialiasing = 4;
    const Picture first = studio.shoot(size_px);
    for (int frame = 0; frame < 5; ++frame) {
        const Picture next = studio.shoot(size_px);
        for (std::size_t i = 0; i < first.image.pixels.size(); ++i)
            ASSERT_NEAR(next.image.pixels[i], first.image.pixels[i], 1e-6) << frame << " " << i;
    }
}

// No halo and no fringe, against a bright sky too: a pixel lies between what it and the four around it show.
TEST_F(AntialiasingTest, NothingIsBrighterOrDarkerThanWhatIsAround) {
    Studio plain(sunlit_slabs());
    Studio smooth(sunlit_slabs());
    for (Studio* studio : {&plain, &smooth}) {
        studio->settings().camera_pitch_deg = -35;
        studio->settings().camera_position_vox = {10, 26, 40};
        studio->settings().sky_zenith = studio->settings().sky_horizon = glm::vec3(50);
    }
    smooth.settings().antialiasing = 4;
    const Picture a = plain.shoot(size_px);
    const Picture b = smooth.shoot(size_px);
    int changed = 0;
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            glm::dvec3 low = a.at(x, y);
            glm::dvec3 high = low;
            for (const glm::ivec2 step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                const glm::ivec2 tap = glm::clamp(glm::ivec2(x, y) + step, glm::ivec2(0), size_px - 1);
                low = glm::min(low, a.at(tap.x, tap.y));
                high = glm::max(high, a.at(tap.x, tap.y));
            }
            for (int c = 0; c < 3; ++c) {
                EXPECT_GE(b.at(x, y)[c], low[c] - 1e-5 * std::abs(low[c])) << x << " " << y;
                EXPECT_LE(b.at(x, y)[c], high[c] + 1e-5 * std::abs(high[c])) << x << " " << y;
            }
            changed += b.at(x, y) == a.at(x, y) ? 0 : 1;
        }
    EXPECT_GT(changed, 60);
}

TEST_F(AntialiasingTest, PictureAndRadianceShowTheSameAtEveryResolutionScale) {
    for (const bool guided : {false, true})
        for (const float scale : {1.0f, 0.5f}) {
            Studio studio(tower());
            Settings& s = studio.settings();
            s.antialiasing = 4;
            s.tone_map = ToneMap::Linear;
            s.history = History::Count;
            s.resolution_scale = scale;
            s.guided_upsampling = guided;
            Picture linear;
            for (int frame = 0; frame < 4; ++frame) linear = studio.shoot(size_px);
            const ImageRgba8 picture = studio.renderer.read_picture();
            int mixed_pixels = 0;
            for (std::size_t i = 0; i < linear.image.pixels.size(); ++i) {
                const double value = linear.image.pixels[i];
                const double code =
                    value < 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
                EXPECT_NEAR(picture.pixels[4 * (i / 3) + i % 3], 255 * code, 0.6);
                mixed_pixels += value > 0.01 && value < 0.99 ? 1 : 0;
            }
            EXPECT_GT(mixed_pixels, 60) << guided << " " << scale;
        }
}

}  // namespace
}  // namespace tarn
