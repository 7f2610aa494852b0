// The path tracer against answers known in closed form, and the faults of the 2023 design that concern light.
#include "microfacet_energy.h"
#include "picture.h"

namespace tarn {
namespace {

class LightTest : public GlTest {};

TEST_F(LightTest, FurnaceByBsdfAloneIsExactForEveryBounceCount) {
    for (const int bounces : {0, 1, 2, 3, 7, 20}) {
        const Picture picture = picture_of(load_scene("furnace", Settings{}), 2, {32, 18}, [&](Settings& s) {
            s.max_bounces = bounces;
            s.light_sampling = LightSampling::None;
            s.roulette_after = 1024;
        });
        EXPECT_LT(picture.worst(1 - std::pow(0.5, bounces + 1)), 2e-7) << bounces << " bounces";
        EXPECT_EQ(picture.rejected, 0u);
    }
}

TEST_F(LightTest, FurnaceWithLightSamplingAndRouletteIsTheSameInTheMean) {
    // A bright sun and sky outside the closed box: sampled at every vertex, they must never be seen.
    for (const float radius_deg : {0.0f, 5.0f}) {
        Scene scene = load_scene("furnace", Settings{});
        scene.settings.sun_irradiance = glm::vec3(50);
        scene.settings.sun_angular_radius_deg = radius_deg;
        scene.settings.sky_zenith = scene.settings.sky_horizon = glm::vec3(7);
        const Picture picture = picture_of(scene, 40, {64, 64}, [](Settings& s) {
            s.max_bounces = 6;
            s.light_sampling = LightSampling::All;
            s.roulette_after = 0;
        });
        EXPECT_NEAR(picture.mean().x, 1 - std::pow(0.5, 7), 4 * picture.standard_error());
        EXPECT_LT(picture.standard_error(), 2.5e-3);
    }
}

TEST_F(LightTest, ChanceEndsNoPathThroughClearSlabsThatLosesNoLight) {
    // Six slabs of clear glass under a sky of 1 all around: every path that is let through returns 1.
    std::string text =
        R"({"size": [16, 26, 16], "camera": {"position_vox": [8, 40, 8], "pitch_deg": -80, "fov_deg": 15},
        "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]},
        "materials": {"glass": {"absorption_per_m": [0, 0, 0]}}, "build": [)";
    for (int y = 2; y < 26; y += 4)
        text += fmt::format(R"({{"box": {{"min": [0, {}, 0], "max": [16, {}, 16], "material": "glass"}}}}{})",
                            y, y + 2, y + 4 < 26 ? "," : "]}");
    const auto passed = [&](int bounces) {
        return picture_of(scene_from(text), 1, {32, 32}, [&](Settings& s) {
            apply_quality(s, Quality::Balanced);
            s.resolution_scale = 1;
            s.max_bounces = bounces;
            s.history = History::None;
            s.filter = Filter::None;
        });
    };
    EXPECT_LT(passed(64).worst(1), 1e-4);
    // Endless paths may be trapped: there chance must end some.
    const Picture endless = passed(1024);
    EXPECT_GT(endless.worst(1), 0.5);
    EXPECT_NEAR(endless.mean().x, 1, 4 * endless.standard_error());
}

TEST_F(LightTest, Fault5_APathThatRunsOutOfBouncesAddsNothing) {
    // A white box without light: whatever comes back at the end of a path was made up.
    Scene scene = load_scene("furnace", Settings{});
    scene.materials[MATERIAL_WALL].base_color = glm::vec3(1);
    scene.materials[MATERIAL_WALL].emission = glm::vec3(0);
    scene.settings.sky_horizon = scene.settings.sky_zenith = glm::vec3(5);
    const Picture picture = picture_of(scene, 1, {16, 16}, [](Settings& s) {
        s.max_bounces = 3;
        s.roulette_after = 1024;
    });
    EXPECT_EQ(picture.worst(0), 0);
}

TEST_F(LightTest, Fault5_TheSkyIsTheSameAtFirstAndLaterHits) {
    const char* const mirror = R"({"size": [8, 4, 8], "materials": {"metal": {"base_color": [1, 1, 1],
        "roughness": 0, "metallic": 1}}, "camera": {"position_vox": [4, 3, 4], "pitch_deg": -40, "fov_deg": 10},
        "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [0.1, 0.5, 2], "horizon": [1, 0.4, 0.2]},
        "build": [{"box": {"min": [0, 0, 0], "max": [8, 1, 8], "material": "metal"}}]})";
    const auto still = [](Settings& s) { s.jitter = false; };
    const Picture reflected = picture_of(scene_from(mirror), 1, {9, 9}, still);
    const Picture direct = picture_of(scene_from(mirror), 1, {9, 9}, [&](Settings& s) {
        still(s);
        s.camera_pitch_deg = 40;
    });
    for (int y = 0; y < 9; ++y)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(reflected.at(4, y)[c], direct.at(4, 8 - y)[c], 1e-5);
}

// A basin of water over a black lamp, seen straight down from above.
Scene lamp_under_water(int depth_vox) {
    Scene scene = scene_from(R"({"size": [9, 40, 9], "metres_per_voxel": 0.5,
        "camera": {"position_vox": [4.5, 38, 4.5], "pitch_deg": -90, "fov_deg": 1},
        "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"lamp": {"base_color": [0, 0, 0], "emission": [3, 3, 3]},
                      "water": {"ior": 1.333, "absorption_per_m": [0.5, 0.25, 0]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [9, 1, 9], "material": "lamp"}}]})");
    for (int y = 1; y <= depth_vox; ++y)
        for (int z = 0; z < 9; ++z)
            for (int x = 0; x < 9; ++x) scene.cells.at({x, y, z}) = MATERIAL_WATER_FULL;
    return scene;
}

TEST_F(LightTest, Fault6_WaterAbsorbsByDistanceAndFresnelIsExact) {
    const double n = 1.333;
    const double transmitted = 1 - exact_fresnel(1, n);
    for (const int depth : {1, 2, 8, 30}) {
        // One interface and black lamps: each path either reflects into the black sky or sees the lamp.
        const Picture picture = picture_of(lamp_under_water(depth), 64, {32, 32});
        const double metres = 0.5 * depth;
        const double lamp = 3 * transmitted / (n * n);
        EXPECT_NEAR(picture.mean().x, lamp * std::exp(-0.5 * metres), 0.002 * lamp) << depth;
        EXPECT_NEAR(picture.mean().y, lamp * std::exp(-0.25 * metres), 0.002 * lamp) << depth;
        EXPECT_NEAR(picture.mean().z, lamp, 0.002 * lamp) << depth;
    }
}

TEST_F(LightTest, Fault6_ReflectanceAtAnAngleIsFresnelsAndNotSchlicks) {
    for (const double angle_deg : {0.0, 45.0, 70.0, 80.0}) {
        // Black ground under the water, a white sky: what comes back is what the surface reflects.
        Scene scene = lamp_under_water(1);
        scene.materials[MATERIAL_LAMP].emission = glm::vec3(0);
        scene.settings.sky_zenith = scene.settings.sky_horizon = glm::vec3(1);
        const double radians = angle_deg * 3.14159265358979 / 180;
        scene.settings.camera_position_vox = {4.5f, 2 + 4 * static_cast<float>(std::cos(radians)),
                                              4.5f + 4 * static_cast<float>(std::sin(radians))};
        scene.settings.camera_pitch_deg = static_cast<float>(angle_deg - 90);
        scene.settings.camera_fov_deg = 1;
        const Picture picture = picture_of(scene, 100, {32, 32});
        const double expected = exact_fresnel(std::cos(radians), 1.333);
        EXPECT_NEAR(picture.mean().x, expected, 0.004 + 0.01 * expected) << angle_deg;
    }
}

TEST_F(LightTest, ASmoothGlassFurnaceLosesAndGainsNothing) {
    const Picture picture = picture_of(scene_from(R"({"size": [24, 24, 24],
        "camera": {"position_vox": [12, 14, 40], "pitch_deg": -5, "fov_deg": 40}, "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]}, "materials": {"glass": {"absorption_per_m": [0, 0, 0]}},
        "build": [{"sphere": {"center": [12, 12, 12], "radius": 9, "material": "glass"}},
                  {"box": {"min": [9, 9, 9], "max": [14, 15, 14], "material": "air"}}]})"),
                                       8, {48, 48}, [](Settings& s) { s.roulette_after = 1024; });
    EXPECT_LT(picture.worst(1), 2e-5);
}

TEST_F(LightTest, AWhiteDiffuseFurnaceLosesAndGainsNothing) {
    const char* const text = R"({"size": [24, 24, 24],
        "camera": {"position_vox": [12, 14, 40], "pitch_deg": -5, "fov_deg": 40}, "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]},
        "materials": {"wall": {"base_color": [1, 1, 1], "ior": 1}},
        "build": [{"sphere": {"center": [12, 12, 12], "radius": 9, "material": "wall"}}]})";
    const Picture plain =
        picture_of(scene_from(text), 8, {48, 48}, [](Settings& s) { s.roulette_after = 1024; });
    EXPECT_LT(plain.worst(1), 1e-6);
    for (const float roughness : {0.0f, 0.2f, 0.5f, 1.0f}) {
        Scene scene = scene_from(text);
        scene.materials[MATERIAL_WALL].ior = 1.5f;
        scene.materials[MATERIAL_WALL].roughness = roughness;
        const Picture coated = picture_of(scene, 32, {48, 48}, [](Settings& s) { s.roulette_after = 1024; });
        // The table of albedos is interpolated: half a percent at most.
        EXPECT_NEAR(coated.mean().x, 1, 0.005) << "roughness " << roughness;
    }
}

// A pillar on a white floor under a large sun, so that chance finds the sun as well.
Scene pillar(const char* floor_material) {
    Scene scene = scene_from(R"({"size": [24, 16, 24],
        "camera": {"position_vox": [12, 15, 23], "pitch_deg": -45, "fov_deg": 60},
        "sun": {"azimuth_deg": 60, "elevation_deg": 40, "irradiance": [3, 3, 3], "angular_radius_deg": 10},
        "sky": {"zenith": [0.2, 0.2, 0.2], "horizon": [0.2, 0.2, 0.2]},
        "materials": {"metal": {"roughness": 0.4, "base_color": [0.9, 0.9, 0.9]},
                      "stone": {"ior": 1.5, "roughness": 0.4}, "glass": {"roughness": 0.4}},
        "build": [{"box": {"min": [0, 0, 0], "max": [24, 2, 24], "material": "wall"}},
                  {"box": {"min": [11, 2, 9], "max": [14, 8, 12], "material": "wall"}}]})");
    const std::uint8_t id = *material_id(floor_material);
    for (std::uint8_t& cell : scene.cells.bytes())
        if (cell == MATERIAL_WALL) cell = id;
    return scene;
}

TEST_F(LightTest, SamplingTheSunAndTheSkyChangesNoMean) {
    for (const char* material : {"wall", "stone", "metal", "glass"}) {
        const auto with = [&](LightSampling sampling) {
            return picture_of(pillar(material), sampling == LightSampling::None ? 144 : 48, {64, 64},
                              [&](Settings& s) { s.light_sampling = sampling; });
        };
        const Picture chance = with(LightSampling::None);
        for (const LightSampling sampling : {LightSampling::Lights, LightSampling::All}) {
            const Picture sampled = with(sampling);
            // The pixels differ among themselves by more than their noise: this error is an upper bound.
            const double error = std::hypot(chance.standard_error(), sampled.standard_error());
            EXPECT_NEAR(sampled.mean().x, chance.mean().x, std::min(3 * error, 0.02 * chance.mean().x))
                << material;
        }
    }
}

TEST_F(LightTest, TheSunThroughWaterAgreesWithChance) {
    Scene scene = pillar("wall");
    for (int y = 2; y < 6; ++y)
        for (int z = 0; z < 24; ++z)
            for (int x = 0; x < 24; ++x)
                if (scene.cells.at({x, y, z}) == MATERIAL_AIR && x > 3 && z < 20)
                    scene.cells.at({x, y, z}) = static_cast<std::uint8_t>(water_cell(y == 5 ? 9 : 16));
    const auto with = [&](bool connected) {
        return picture_of(scene, 96, {64, 64}, [&](Settings& s) {
            s.light_sampling = connected ? LightSampling::Lights : LightSampling::None;
            s.sun_through_water = connected;
        });
    };
    const Picture chance = with(false);
    const Picture connected = with(true);
    EXPECT_NEAR(connected.mean().x, chance.mean().x, 0.015 * chance.mean().x);
    EXPECT_GT(chance.mean().x, 0.1);
}

// A bed under rough water, frosted glass in smooth water: what the sun sends through rough interfaces is
// sampled there.
Scene rough_pool(float water_roughness, bool glass) {
    Scene scene = scene_from(R"({"size": [24, 16, 24],
        "camera": {"position_vox": [12, 15, 20], "pitch_deg": -50, "fov_deg": 40},
        "sun": {"azimuth_deg": 60, "elevation_deg": 50, "irradiance": [3, 3, 3], "angular_radius_deg": 10},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"glass": {"roughness": 0.6}, "wall": {"base_color": [0.6, 0.6, 0.6]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [24, 2, 24], "material": "wall"}},
                  {"box": {"min": [0, 2, 0], "max": [24, 6, 24], "material": "water"}}]})");
    scene.materials[MATERIAL_WATER].roughness = water_roughness;
    if (glass)
        for (int z = 8; z < 16; ++z)
            for (int y = 2; y < 9; ++y)
                for (int x = 8; x < 16; ++x) scene.cells.at({x, y, z}) = MATERIAL_GLASS;
    return scene;
}

TEST_F(LightTest, TheSunThroughRoughInterfacesAgreesWithChance) {
    for (const auto& [roughness, glass] : {std::pair(0.4f, false), {0.0f, true}, {0.4f, true}}) {
        // Independent pictures: chance is too noisy for the spread of pixels to tell its error.
        const auto with = [&, r = roughness, g = glass](LightSampling sampling, int frames) {
            constexpr int pictures = 10;
            double sum = 0;
            double squares = 0;
            for (std::uint32_t seed = 1; seed <= pictures; ++seed) {
                Scene scene = rough_pool(r, g);
                scene.seed = seed + 100 * static_cast<std::uint32_t>(sampling);
                const double mean =
                    picture_of(scene, frames, {64, 64}, [&](Settings& s) { s.light_sampling = sampling; })
                        .mean()
                        .x;
                sum += mean / pictures;
                squares += mean * mean / pictures;
            }
            return std::pair(sum, std::sqrt((squares - sum * sum) / (pictures - 1)));
        };
        const auto [chance, chance_error] = with(LightSampling::None, 60);
        const auto [sampled, sampled_error] = with(LightSampling::Lights, 12);
        const double error = std::hypot(chance_error, sampled_error);
        EXPECT_NEAR(sampled, chance, 3 * error) << roughness << " " << glass;
        EXPECT_LT(error, 0.015 * sampled);
        // Where light is not found by chance at all, little of it is missing.
        const Picture preset = picture_of(rough_pool(roughness, glass), 48, {64, 64}, [](Settings& s) {
            s.caustics = false;
            s.straight_sunlight = true;
        });
        EXPECT_NEAR(preset.mean().x, sampled, 0.15 * sampled) << roughness << " " << glass;
    }
}

TEST_F(LightTest, AShadowsEdgeUnderWaterLiesWhereRefractionPutsIt) {
    // A roof from x = 16 with its underside at y = 9; water from y = 1 to 5; the sun towards +x at 45
    // degrees.
    Scene scene = scene_from(R"({"size": [32, 16, 8],
        "camera": {"position_vox": [8, 14, 4], "pitch_deg": -90, "fov_deg": 1.1},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"water": {"absorption_per_m": [0, 0, 0], "ior": 1.333}, "wall": {"base_color": [0.9, 0.9, 0.9]}},
        "sun": {"irradiance": [3, 3, 3], "azimuth_deg": 90, "elevation_deg": 45, "angular_radius_deg": 0},
        "build": [{"box": {"min": [0, 0, 0], "max": [32, 1, 8], "material": "wall"}},
                  {"box": {"min": [0, 1, 0], "max": [32, 5, 8], "material": "water"}},
                  {"box": {"min": [16, 9, 0], "max": [32, 10, 8], "material": "wall"}}]})");
    // The last lit ray passes the roof's upper corner at (16, 10): it rises towards +x.
    const double sin_t = std::sqrt(0.5) / 1.333;
    const double in_water = 4 * sin_t / std::sqrt(1 - sin_t * sin_t);
    const double edge = 16 - (10 - 5) - in_water;
    const auto light_at = [&](double x) {
        scene.settings.camera_position_vox.x = static_cast<float>(x);
        return picture_of(scene, 16, {8, 8}, [](Settings& s) { s.max_diffuse_bounces = 1; }).mean().x;
    };
    const double lit = light_at(edge - 1.5);
    EXPECT_GT(lit, 0.1);
    EXPECT_NEAR(light_at(edge - 0.25), lit, 0.1 * lit);
    EXPECT_LT(light_at(edge + 0.25), 0.1 * lit);
}

TEST_F(LightTest, ASmallSunsDiscHasItsIrradiance) {
    // A mirror of a floor is not needed: a wide diffuse bounce is. The disc is looked at directly, in a
    // narrow view.
    for (const float radius_deg : {0.27f, 0.05f, 0.02f}) {
        Scene scene = scene_from(R"({"size": [2, 2, 2], "camera": {"position_vox": [1, 1, 1], "yaw_deg": 30,
            "pitch_deg": 40}, "sun": {"azimuth_deg": 30, "elevation_deg": 40, "irradiance": [2, 2, 2]},
            "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]}})");
        scene.settings.sun_angular_radius_deg = radius_deg;
        scene.settings.camera_fov_deg = 4 * radius_deg;
        if (scene.settings.camera_fov_deg < 1) scene.settings.camera_fov_deg = 1;
        constexpr int side = 256;
        const Picture picture = picture_of(scene, 16, {side, side});
        const double half = std::tan(scene.settings.camera_fov_deg * 3.14159265358979 / 360);
        // Nearly parallel rays: a pixel's solid angle is its area at distance 1.
        const double irradiance = picture.mean().x * 4 * half * half;
        EXPECT_NEAR(irradiance, 2, 0.03) << radius_deg;
    }
}

TEST_F(LightTest, TheUnseenSunOfAPointLightsTheFloorByItsIrradiance) {
    const Picture picture = picture_of(scene_from(R"({"size": [8, 4, 8],
        "camera": {"position_vox": [4, 3, 4], "pitch_deg": -90, "fov_deg": 20},
        "sun": {"elevation_deg": 30, "irradiance": [2, 2, 2], "angular_radius_deg": 0},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"wall": {"base_color": [0.5, 0.5, 0.5]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [8, 1, 8], "material": "wall"}}]})"),
                                       1, {8, 8});
    EXPECT_LT(picture.worst(0.5 / 3.14159265358979 * 2 * 0.5), 1e-6);
}

TEST_F(LightTest, RaysThatMissTheWorldSeeTheSkyFromEverySide) {
    Scene scene = scene_from(R"({"size": [64, 8, 20], "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [1, 1, 1], "horizon": [1, 1, 1]}, "materials": {"wall": {"base_color": [0, 0, 0]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [64, 8, 20], "material": "wall"}}]})");
    struct Eye {
        glm::vec3 position_vox;
        float yaw_deg, pitch_deg;
    };
    // One eye a side of the black slab, its axis aimed at the slab's centre.
    for (const Eye& eye :
         {Eye{{32, 4, 120}, 0, 0}, Eye{{32, 4, -100}, 180, 0}, Eye{{-100, 4, 10}, 90, 0},
          Eye{{164, 4, 10}, -90, 0}, Eye{{32, 110, 10}, 0, -90}, Eye{{32, -110, 10}, 0, 90}}) {
        scene.settings.camera_position_vox = eye.position_vox;
        scene.settings.camera_yaw_deg = eye.yaw_deg;
        scene.settings.camera_pitch_deg = eye.pitch_deg;
        scene.settings.camera_fov_deg = 100;
        const Picture picture = picture_of(scene, 1, {65, 65});
        EXPECT_EQ(picture.at(32, 32).x, 0) << "the slab is in the middle";
        for (int i = 0; i < 65; ++i)
            for (const auto& [x, y] : {std::pair{i, 0}, {i, 10}, {i, 54}, {i, 64}, {0, i}, {64, i}})
                EXPECT_EQ(picture.at(x, y).x, 1)
                    << x << ", " << y << " yaw " << eye.yaw_deg << " pitch " << eye.pitch_deg;
    }
}

TEST_F(LightTest, ExactModeGoesOnOverTicksOfAWorldAtRestAndRestartsWithAnyByte) {
    Scene scene = pillar("wall");
    apply_quality(scene.settings, Quality::Exact);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    const auto frame = [&] { renderer.render(simulation, scene.settings, {8, 8}); };
    for (int i = 0; i < 4; ++i) {
        simulation.step(1, scene.settings);
        frame();
    }
    EXPECT_EQ(renderer.samples(), 4u);
    EditHistory history;
    history.begin_stroke();
    simulation.apply({.center_vox = {3, 10, 3}, .material = MATERIAL_SAND}, history);
    frame();
    EXPECT_EQ(renderer.samples(), 1u);
    frame();
    EXPECT_EQ(renderer.samples(), 2u);
    simulation.step(2, scene.settings);  // the sand falls: once at least in two ticks
    frame();
    EXPECT_EQ(renderer.samples(), 1u);
    scene.settings.camera_yaw_deg += 1;
    frame();
    EXPECT_EQ(renderer.samples(), 1u);
}

TEST_F(LightTest, Fault8_AccuracyIsMeasuredAndGrowsWithSamples) {
    const Scene scene = pillar("wall");
    const Picture reference = picture_of(scene, 1024, {32, 32});
    const auto error_of = [&](int samples) {
        const Picture picture = picture_of(scene, samples, {32, 32});
        double sum = 0;
        const double floor = 0.01 * reference.mean().x * reference.mean().x;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                const double d = picture.at(x, y).x - reference.at(x, y).x;
                sum += d * d / (reference.at(x, y).x * reference.at(x, y).x + floor);
            }
        return sum / (32 * 32);
    };
    // relMSE falls as 1 / samples.
    const double ratio = error_of(8) / error_of(64);
    EXPECT_GT(ratio, 5);
    EXPECT_LT(ratio, 13);
}

}  // namespace
}  // namespace tarn
