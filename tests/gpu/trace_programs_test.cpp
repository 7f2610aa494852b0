// Programs of the trace pass: what one can do beyond its scene changes no bit; one that can do more serves
// until the program that was asked for is there; what an earlier run linked makes the same picture.
#include "passes/trace_programs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/renderer.h"
#include "core/files.h"
#include "gl/program_cache.h"
#include "gl_test.h"
#include "world/scene.h"

namespace tarn {
namespace {

constexpr glm::ivec2 size_px{40, 24};

using TraceProgramsTest = GlTest;

// A floor, a wall and what `build` adds, under a sun; quality balanced.
Scene room(const std::string& build) {
    Settings settings;
    apply_quality(settings, Quality::Balanced);
    return parse_scene(R"({"size": [32, 24, 32], "metres_per_voxel": 0.25,
        "camera": {"position_vox": [16, 14, 31], "pitch_deg": -20},
        "sun": {"azimuth_deg": 120, "elevation_deg": 40}, "build": [
        {"box": {"min": [0, 0, 0], "max": [32, 4, 32], "material": "stone"}},
        {"box": {"min": [4, 4, 4], "max": [10, 14, 8], "material": "wall"}})" +
                           build + "]}",
                       "room", settings);
}
const char* const pool = R"(, {"box": {"min": [12, 2, 8], "max": [26, 4, 24], "material": "water"}})";
const char* const lamp = R"(, {"box": {"min": [20, 8, 8], "max": [21, 9, 9], "material": "lamp"}})";

std::vector<float> picture(Renderer& renderer, const Simulation& simulation, const Scene& scene,
                           int frames = 2) {
    for (int i = 0; i < frames; ++i) renderer.render(simulation, scene.settings, size_px);
    return renderer.read_radiance().pixels;
}

TEST_F(TraceProgramsTest, WhatTheSceneHasNoNeedOfChangesNoBit) {
    const auto only = [](bool TraceFeatures::*feature) {
        TraceFeatures features;
        features.*feature = true;
        return features;
    };
    const TraceFeatures clear = only(&TraceFeatures::clear);
    TraceFeatures rough = clear, smooth_water = clear, all = rough;
    rough.rough = smooth_water.smooth_water = true;
    all.rough = all.smooth_water = all.coated = all.emitters = all.sun = true;
    const TraceFeatures coated = only(&TraceFeatures::coated), emitters = only(&TraceFeatures::emitters);
    struct Case {
        Scene scene;
        std::vector<TraceFeatures> without_need;
    };
    Scene night = room(std::string(pool) + lamp);
    night.settings.sun_irradiance = glm::vec3(0);
    for (const Case& c : {Case{room(""), {clear, rough, smooth_water, coated, emitters, all}},
                          Case{room(pool), {rough, coated, emitters, all}},
                          Case{night, {only(&TraceFeatures::sun), rough, coated, all}}}) {
        gl::Timers timers;
        const Simulation simulation(c.scene, timers);
        Renderer plain(c.scene, timers);
        const std::vector<float> expected = picture(plain, simulation, c.scene);
        for (std::size_t i = 0; i < c.without_need.size(); ++i) {
            Renderer able(c.scene, timers);
            able.compile_in(c.without_need[i]);
            EXPECT_EQ(picture(able, simulation, c.scene), expected) << "case " << i;
        }
    }
}

// The first metal comes while the program without it is all there is but the general one.
TEST_F(TraceProgramsTest, TheGeneralProgramServesUntilTheSpecialOneIsBuilt) {
    const Scene scene = room(pool);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    TracePrograms programs(platform()->make_shared_context());
    Renderer beside(scene, timers, &programs);
    Renderer at_once(scene, timers);
    const auto both_agree = [&] {
        return picture(beside, simulation, scene, 1) == picture(at_once, simulation, scene, 1);
    };
    EXPECT_TRUE(both_agree());
    EXPECT_EQ(programs.size(), 1u);
    const double waited_ms = programs.waited_ms();
    EXPECT_TRUE(both_agree());  // orders the general one
    programs.wait();
    EditHistory history;
    history.begin_stroke();
    simulation.apply({.tick = 0,
                      .shape = BrushShape::Sphere,
                      .center_vox = {22, 10, 10},
                      .radius_vox = 3,
                      .material = MATERIAL_METAL,
                      .overwrite = true},
                     history);
    EXPECT_TRUE(both_agree());
    EXPECT_GE(programs.size(), 1u);
    programs.wait();
    // The special one takes over within some frames, and no bit tells when.
    while (programs.size() < 3) {
        EXPECT_TRUE(both_agree());
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    EXPECT_TRUE(both_agree());
    EXPECT_EQ(programs.waited_ms(), waited_ms) << "no frame after the first waited for a program";
}

// Shading of water as it was serves until the program of the new one is there.
TEST_F(TraceProgramsTest, ASettingTakesEffectWithItsProgram) {
    Scene scene = room(pool);
    gl::Timers timers;
    const Simulation simulation(scene, timers);
    TracePrograms programs(platform()->make_shared_context());
    Renderer renderer(scene, timers, &programs);
    picture(renderer, simulation, scene);
    const double waited_ms = programs.waited_ms();
    scene.settings.smooth_water = false;
    scene.settings.history = History::Exact;
    programs.wait();
    const std::size_t before = programs.size();
    picture(renderer, simulation, scene, 1);
    programs.wait();
    picture(renderer, simulation, scene, 2);  // one takes the program, the next begins its mean
    EXPECT_GT(programs.size(), before);
    Renderer fresh(scene, timers);
    // Exact mode: the mean of one frame, of the same number.
    renderer.set_frame_index(7);
    fresh.set_frame_index(7);
    renderer.reset_history();
    EXPECT_EQ(picture(renderer, simulation, scene, 1), picture(fresh, simulation, scene, 1));
    EXPECT_EQ(programs.waited_ms(), waited_ms);
}

TEST_F(TraceProgramsTest, ProgramsOfAnEarlierRunMakeTheSamePicture) {
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / fmt::format("tarn_programs_{}", getpid());
    std::filesystem::remove_all(folder);
    setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    unsetenv("TARN_PROGRAM_CACHE");
    const TraceFeatures all{.skip = true,
                            .clear = true,
                            .rough = true,
                            .coated = true,
                            .sun = true,
                            .emitters = true,
                            .smooth_water = true};
    const Scene scene = room(std::string(pool) + lamp);
    gl::Timers timers;
    const auto shown = [&] {
        const Simulation simulation(scene, timers);
        Renderer renderer(scene, timers);
        renderer.compile_in(all);
        return picture(renderer, simulation, scene);
    };
    const auto cached = [&] { return TracePass(all).program().was_cached(); };
    const std::vector<float> first = shown();
    // Mesa hands out no binaries while its own cache is off.
    EXPECT_EQ(cached(), formats > 0);
    EXPECT_EQ(shown(), first);
    // Cut off: as if there were none.
    if (formats > 0) {
        for (const auto& entry : std::filesystem::directory_iterator(folder / "tarn"))
            std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
    }
    EXPECT_FALSE(cached());
    EXPECT_EQ(cached(), formats > 0) << "written anew";
    // In a format that this driver does not know.
    if (formats > 0) {
        for (const auto& entry : std::filesystem::directory_iterator(folder / "tarn")) {
            std::string bytes = read_text_file(entry.path());
            bytes[32] = static_cast<char>(bytes[32] ^ 1);
            write_file(entry.path(), bytes);
        }
    }
    EXPECT_FALSE(cached());
    EXPECT_EQ(cached(), formats > 0) << "written anew";
    EXPECT_EQ(shown(), first);
    setenv("TARN_PROGRAM_CACHE", "off", 1);
    EXPECT_FALSE(cached());
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace tarn
