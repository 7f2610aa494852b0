// The surface of partly filled voxels: as it is, against slabs traced in double precision by planes, with no
// voxel in them; and shaded smooth.
#include <numbers>
#include <vector>

#include "studio.h"

namespace tarn {
namespace {

constexpr double ior = 1.333;
constexpr glm::dvec3 absorption_per_m{0.5, 0.25, 0.1};
constexpr glm::dvec3 lamp_radiance{3, 2, 1};
constexpr glm::dvec3 sky_radiance{0.25, 0.5, 1};

double reflectance(double cos_i, double eta) {
    const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1) return 1;
    const double cos_t = std::sqrt(1 - sin2_t);
    const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return (parallel * parallel + perpendicular * perpendicular) / 2;
}

// A basin whose floor and walls, one voxel thick and as high as the world, are lamps that reflect nothing.
// Its water stands at levels[0] where x < step_x and at levels[1] >= levels[0] beyond.
struct Basin {
    glm::ivec3 size{24, 8, 16};
    int step_x = 12;
    glm::ivec2 quanta{16 + 5, 16 + 11};  // above the floor
    double metres_per_voxel = 1;

    double level(int half) const { return 1 + quanta[half] / 16.0; }

    Scene scene() const {
        Scene scene = plain_scene(fmt::format(
            R"({{"size": [{}, {}, {}], "metres_per_voxel": {}, "sun": {{"irradiance": [0, 0, 0]}},
            "sky": {{"zenith": [0.25, 0.5, 1], "horizon": [0.25, 0.5, 1]}},
            "materials": {{"lamp": {{"base_color": [0, 0, 0], "emission": [3, 2, 1]}},
                           "water": {{"ior": 1.333, "absorption_per_m": [0.5, 0.25, 0.1]}}}}}})",
            size.x, size.y, size.z, metres_per_voxel));
        for (int z = 0; z < size.z; ++z) {
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const bool solid = y == 0 || std::min(x, z) == 0 || x == size.x - 1 || z == size.z - 1;
                    const int water = std::clamp(quanta[x >= step_x] - 16 * (y - 1), 0, 16);
                    scene.cells.at({x, y, z}) =
                        solid ? MATERIAL_LAMP : static_cast<std::uint8_t>(water_cell(water));
                }
            }
        }
        scene.settings.roulette_after = 1024;
        return scene;
    }
};

// What one path can return, and how likely it is.
struct Outcome {
    glm::dvec3 radiance;
    double probability;
};

struct Outcomes {
    std::vector<Outcome> list;
    bool near_edge = false;  // some ray passes so near an edge of the step that float may take the other side
    bool meets_step = false;
    glm::dvec3 mean{0}, variance{0};
};

class Analytic {
  public:
    explicit Analytic(const Basin& basin) : basin_(basin) {}

    Outcomes trace(glm::dvec3 origin, glm::dvec3 dir) const {
        Outcomes result;
        const double surface = basin_.level(origin.x >= basin_.step_x);
        follow({origin, dir, glm::dvec3(1), 1, origin.y < surface}, result);
        for (const Outcome& o : result.list) result.mean += o.probability * o.radiance;
        for (const Outcome& o : result.list)
            result.variance += o.probability * (o.radiance - result.mean) * (o.radiance - result.mean);
        return result;
    }

  private:
    struct Ray {
        glm::dvec3 origin, dir, weight;
        double probability;
        bool wet;
    };

    void follow(Ray ray, Outcomes& result) const {
        constexpr double edge_vox = 0.01;
        if (ray.probability < 1e-7) return;
        const glm::dvec3 low(1, 1, 1);
        const glm::dvec3 high(basin_.size.x - 1, basin_.size.y, basin_.size.z - 1);
        double t = 1e300;
        bool sky = false;
        for (int k = 0; k < 3; ++k) {
            if (ray.dir[k] == 0) continue;
            const double plane = ((ray.dir[k] > 0 ? high : low)[k] - ray.origin[k]) / ray.dir[k];
            if (plane < t) {
                t = plane;
                sky = k == 1 && ray.dir.y > 0;
            }
        }
        int axis = -1;  // of the water's surface, if that is met first
        for (int half = 0; half < 2; ++half) {
            const double top = (basin_.level(half) - ray.origin.y) / ray.dir.y;
            const double x = ray.origin.x + top * ray.dir.x;
            if (!(top > 1e-9 && top < t) || (ray.dir.y > 0) != ray.wet) continue;
            if (stepped() && std::abs(x - basin_.step_x) < edge_vox) result.near_edge = true;
            if ((x >= basin_.step_x) != (half == 1)) continue;
            t = top;
            axis = 1;
        }
        const double flank = (basin_.step_x - ray.origin.x) / ray.dir.x;
        if (stepped() && flank > 1e-9 && flank < t) {
            const double y = ray.origin.y + flank * ray.dir.y;
            for (int half = 0; half < 2; ++half)
                if (std::abs(y - basin_.level(half)) < edge_vox) result.near_edge = true;
            if (y > basin_.level(0) && y < basin_.level(1)) {
                t = flank;
                axis = 0;
                result.meets_step = true;
            }
        }
        if (ray.wet) ray.weight *= glm::exp(-absorption_per_m * (t * basin_.metres_per_voxel));
        if (axis < 0) {
            result.list.push_back({ray.weight * (sky ? sky_radiance : lamp_radiance), ray.probability});
            return;
        }
        ray.origin += t * ray.dir;
        const double eta = ray.wet ? 1 / ior : ior;
        const double cos_i = std::abs(ray.dir[axis]);
        const double f = reflectance(cos_i, eta);
        Ray reflected = ray;
        reflected.dir[axis] = -ray.dir[axis];
        reflected.probability *= f;
        follow(reflected, result);
        if (f == 1) return;
        Ray through = ray;
        through.dir = ray.dir / eta;
        through.dir[axis] = std::copysign(std::sqrt(1 - (1 - cos_i * cos_i) / (eta * eta)), ray.dir[axis]);
        through.weight /= eta * eta;
        through.probability *= 1 - f;
        through.wet = !ray.wet;
        follow(through, result);
    }

    bool stepped() const { return basin_.quanta.x != basin_.quanta.y; }
    Basin basin_;
};

struct Eye {
    const char* name;
    glm::dvec3 position;
    double yaw_deg, pitch_deg, fov_deg;
};

glm::dvec3 ray_through(const Eye& eye, glm::ivec2 px, glm::ivec2 size_px) {
    const double yaw = eye.yaw_deg * std::numbers::pi / 180;
    const double pitch = eye.pitch_deg * std::numbers::pi / 180;
    const double half = std::tan(eye.fov_deg * std::numbers::pi / 360);
    const glm::dvec3 dir(std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
    const glm::dvec3 right(std::cos(yaw), 0, std::sin(yaw));
    const glm::dvec3 up = glm::cross(right, dir);
    const double u = (2.0 * px.x + 1) / size_px.x - 1;
    const double v = 1 - (2.0 * px.y + 1) / size_px.y;
    return glm::normalize(dir + half * (u * size_px.x / size_px.y * right + v * up));
}

bool same(glm::dvec3 found, glm::dvec3 wanted) {
    return glm::all(glm::lessThan(glm::abs(found - wanted), 0.005 * wanted + 1e-7));
}

struct Counts {
    int compared = 0, near_edge = 0, meet_step = 0;
};

class SurfaceTest : public GlTest {
  protected:
    static constexpr glm::ivec2 size_px{96, 64};
    static constexpr int frames = 48;
    static constexpr int block_px = 8;

    // Every path of every pixel returns one of the radiances that the slab allows, within 0.5 %, and as often
    // as Fresnel says: over blocks of pixels, and over the picture within 0.5 %.
    static Counts compare(const Basin& basin, const Eye& eye, const std::function<void(Settings&)>& change) {
        Studio studio(basin.scene());
        Settings& s = studio.settings();
        s.camera_position_vox = eye.position;
        s.camera_yaw_deg = static_cast<float>(eye.yaw_deg);
        s.camera_pitch_deg = static_cast<float>(eye.pitch_deg);
        s.camera_fov_deg = static_cast<float>(eye.fov_deg);
        change(s);
        const Analytic analytic(basin);
        std::vector<Outcomes> expected;
        for (int y = 0; y < size_px.y; ++y)
            for (int x = 0; x < size_px.x; ++x)
                expected.push_back(analytic.trace(eye.position, ray_through(eye, {x, y}, size_px)));

        Counts counts;
        for (const Outcomes& o : expected) {
            counts.near_edge += o.near_edge ? 1 : 0;
            counts.meet_step += o.meets_step ? 1 : 0;
        }
        std::vector<glm::dvec3> sums(expected.size(), glm::dvec3(0));
        int wrong = 0;
        for (int frame = 0; frame < frames; ++frame) {
            const Picture picture = studio.shoot(size_px);
            EXPECT_EQ(picture.rejected, 0u);
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const int x = static_cast<int>(i) % size_px.x;
                const int y = static_cast<int>(i) / size_px.x;
                const glm::dvec3 found = picture.at(x, y);
                sums[i] += found;
                if (expected[i].near_edge) continue;
                ++counts.compared;
                const bool known = std::ranges::any_of(
                    expected[i].list, [&](const Outcome& o) { return same(found, o.radiance); });
                if (!known && wrong++ == 0)
                    ADD_FAILURE() << fmt::format(
                        "{}: pixel {}, {}: a path returned {} {} {}; likeliest {} {} {}", eye.name, x, y,
                        found.x, found.y, found.z, expected[i].list.front().radiance.x,
                        expected[i].list.front().radiance.y, expected[i].list.front().radiance.z);
            }
        }
        EXPECT_EQ(wrong, 0) << eye.name;
        compare_means(expected, sums, eye);
        return counts;
    }

    static void compare_means(const std::vector<Outcomes>& expected, const std::vector<glm::dvec3>& sums,
                              const Eye& eye) {
        glm::dvec3 found(0), wanted(0), variance(0);
        // float32 alone is left where nothing is left to chance.
        const auto unlike = [](glm::dvec3 sum, glm::dvec3 wanted_sum, glm::dvec3 variance_of_it,
                               double sigmas) {
            return glm::any(glm::greaterThan(glm::abs(sum - wanted_sum),
                                             sigmas * glm::sqrt(variance_of_it) + 1e-5 * wanted_sum));
        };
        int blocks_off = 0;
        for (int by = 0; by < size_px.y; by += block_px) {
            for (int bx = 0; bx < size_px.x; bx += block_px) {
                glm::dvec3 block_found(0), block_wanted(0), block_variance(0);
                for (int k = 0; k < block_px * block_px; ++k) {
                    const std::size_t i = (by + k / block_px) * std::size_t{size_px.x} + bx +
                                          static_cast<std::size_t>(k % block_px);
                    if (expected[i].near_edge) continue;
                    block_found += sums[i];
                    block_wanted += 1.0 * frames * expected[i].mean;
                    block_variance += 1.0 * frames * expected[i].variance;
                }
                if (unlike(block_found, block_wanted, block_variance, 6)) ++blocks_off;
                found += block_found;
                wanted += block_wanted;
                variance += block_variance;
            }
        }
        EXPECT_EQ(blocks_off, 0) << eye.name;
        const glm::dvec3 error = glm::abs(found / wanted - 1.0);
        EXPECT_LT(std::max({error.x, error.y, error.z}), 0.005) << eye.name;
        EXPECT_FALSE(unlike(found, wanted, variance, 4.5)) << eye.name;
    }
};

TEST_F(SurfaceTest, ABasinOfTwoHeightsIsTheAnalyticSlabFromAboveBelowAndTheSide) {
    const auto plain_shading = [](Settings& s) { s.smooth_water = false; };
    for (const Eye& eye :
         {Eye{"above", {11.3, 6.9, 8.2}, 20, -88, 75}, Eye{"aslant", {3.3, 5.1, 13.2}, 60, -25, 50},
          Eye{"below the lower half", {6.3, 1.4, 8.2}, 80, 35, 90},
          Eye{"below the higher half", {17.2, 1.2, 7.7}, -75, 20, 80},
          Eye{"the flank", {5.4, 2.55, 8.2}, 88, -0.4, 4},
          Eye{"the flank from within", {16.6, 2.5, 8.2}, -92, 0.3, 6}}) {
        const Counts counts = compare({}, eye, plain_shading);
        // The narrow views see half a voxel magnified to the whole picture.
        EXPECT_LT(counts.near_edge,
                  eye.fov_deg > 10 ? 0.05 * size_px.x * size_px.y : 0.3 * size_px.x * size_px.y)
            << eye.name;
        EXPECT_GT(counts.compared, 0.7 * frames * size_px.x * size_px.y) << eye.name;
        if (eye.fov_deg < 10) {
            EXPECT_GT(counts.meet_step, 0.4 * size_px.x * size_px.y) << eye.name;
        }
    }
}

TEST_F(SurfaceTest, EqualNeighboursShowNoSeamAtAnyPixel) {
    for (const int quanta : {16 + 5, 16 + 16}) {
        const Basin pool{
            .size = {160, 8, 160}, .step_x = 80, .quanta = {quanta, quanta}, .metres_per_voxel = 0.0625};
        // Grazing rays cross up to 220 faces between voxels, in the water and along its surface.
        const double level = pool.level(0);
        for (const Eye& eye : {Eye{"along z", {80.3, level + 0.6, 158.6}, 0.3, -2, 25},
                               Eye{"diagonal", {1.7, level + 0.4, 158.2}, 45, -1, 20},
                               Eye{"from below", {80.3, 1.6, 158.6}, -0.2, 1.5, 25},
                               Eye{"diagonal from below", {1.7, level - 0.1, 158.2}, 45, -0.5, 20}}) {
            // Every two of depth, shading and traversal meet.
            for (const bool smooth : {false, true}) {
                const Traversal traversal =
                    smooth == (quanta > 16 + 5) ? Traversal::Voxel : Traversal::Distance;
                const Counts counts = compare(pool, eye, [&](Settings& s) {
                    s.smooth_water = smooth;
                    s.traversal = traversal;
                });
                EXPECT_EQ(counts.compared, frames * size_px.x * size_px.y);
            }
        }
    }
}

// The largest dip or peak along x of a picture whose columns are alike, against the columns three to each
// side.
double worst_line(const Picture& picture) {
    const int width = picture.image.width;
    std::vector<double> column(width, 0);
    for (int x = 0; x < width; ++x)
        for (int y = 0; y < picture.image.height; ++y) column[x] += picture.at(x, y).y;
    double worst = 0;
    for (int x = 3; x < width - 3; ++x)
        worst = std::max(worst, std::abs(2 * column[x] / (column[x - 3] + column[x + 3]) - 1));
    return worst;
}

TEST_F(SurfaceTest, ALowStepShowsNoLineWhereItIsShadedSmooth) {
    // One quantum, seen along the step from above, the water darker by depth and bright from its side; then
    // the bed in the sun, which must not show the step's shadow.
    const Basin basin{.quanta = {2 * 16 + 5, 2 * 16 + 6}, .metres_per_voxel = 0.05};
    Scene scenes[2] = {basin.scene(), basin.scene()};
    scenes[0].settings.camera_position_vox = {11, 6, 8};
    scenes[0].settings.camera_pitch_deg = -90;
    scenes[0].settings.camera_fov_deg = 60;
    scenes[1].settings.camera_position_vox = {10, 2.5f, 8};
    scenes[1].settings.camera_pitch_deg = -90;
    scenes[1].settings.camera_fov_deg = 80;
    scenes[1].settings.sun_irradiance = glm::vec3(5);
    scenes[1].settings.sun_angular_radius_deg = 0;
    scenes[1].settings.sun_azimuth_deg = 90;
    scenes[1].settings.sun_elevation_deg = 40;
    scenes[1].settings.sky_zenith = scenes[1].settings.sky_horizon = glm::vec3(0);
    for (std::uint8_t& cell : scenes[1].cells.bytes())
        if (cell == MATERIAL_LAMP) cell = MATERIAL_WALL;
    for (int x = 23, y = 1; y < 8; ++y)
        for (int z = 0; z < 16; ++z) scenes[1].cells.at({x, y, z}) = MATERIAL_AIR;
    for (const Scene& scene : scenes) {
        const auto line = [&](bool smooth) {
            return worst_line(picture_of(scene, 150, {192, 128}, [&](Settings& s) {
                s.jitter = false;
                s.max_diffuse_bounces = 1;
                s.smooth_water = smooth;
            }));
        };
        const double as_it_is = line(false);
        const double smooth = line(true);
        EXPECT_GT(as_it_is, 0.015);
        EXPECT_LT(smooth, std::min(0.015, 0.2 * as_it_is));
    }
}

}  // namespace
}  // namespace tarn
