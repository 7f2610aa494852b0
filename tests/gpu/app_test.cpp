// The whole App without a window: an ImGui context of its own stands in for the platform's.
#include "app/app.h"

#include <imgui.h>

#include <filesystem>
#include <set>

#include "app/replay.h"
#include "core/error.h"
#include "gpu/gl_test.h"
#include "gpu/working_folder.h"
#include "world/recording.h"

namespace tarn {
namespace {

constexpr glm::ivec2 size_px{48, 32};

class AppTest : public GlTest {
  protected:
    AppTest() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {static_cast<float>(size_px.x), static_cast<float>(size_px.y)};
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~AppTest() override { ImGui::DestroyContext(); }

    static Input hands(double dt_s = 0.1) {
        Input input;
        input.dt_s = dt_s;
        input.size_px = size_px;
        input.interactive = true;
        return input;
    }
    static Input pressing(Key key) {
        Input input = hands();
        input.pressed[static_cast<std::size_t>(key)] = true;
        input.down[static_cast<std::size_t>(key)] = true;
        return input;
    }
    static Input clicking(MouseButton button) {
        Input input = hands();
        input.mouse_on_picture = true;
        input.mouse_px = glm::vec2(size_px) / 2.f;
        input.mouse_pressed[static_cast<std::size_t>(button)] = true;
        input.mouse_down[static_cast<std::size_t>(button)] = true;
        return input;
    }
    static void play(App& app, const Input& input) {
        ImGui::NewFrame();
        app.frame(input);
        ImGui::Render();
    }

    // A floor of grass under the sky, seen from above its middle.
    static Scene meadow() {
        Scene scene;
        scene.name = "meadow";
        scene.cells = Cells({32, 16, 32});
        for (int z = 0; z < 32; ++z)
            for (int x = 0; x < 32; ++x) scene.cells.at({x, 0, z}) = MATERIAL_GRASS;
        scene.settings.camera_position_vox = {16.5f, 12, 16.5f};
        scene.settings.camera_pitch_deg = -90;
        apply_quality(scene.settings, Quality::Fast);
        return scene;
    }
    static App::Options interactive() { return {.interactive = true, .platform = nullptr}; }
    static std::uint64_t count(App& app, std::uint8_t material) {
        return take_census(app.simulation().read_cells()).voxels[material];
    }
};

TEST_F(AppTest, InputReachesThePictureInItsOwnFrameWhileTicksLag) {
    Scene scene = meadow();
    scene.settings.ticks_per_second = 1000;
    App app(scene, scene.settings, interactive());
    const auto is_blue = [&] {
        const ImageRgba8 picture = app.renderer().read_picture();
        const std::uint8_t* middle =
            &picture.pixels[std::size_t{4} * (size_px.x * (size_px.y / 2) + size_px.x / 2)];
        return middle[2] > middle[1];
    };
    play(app, hands(10));
    EXPECT_FALSE(is_blue()) << "grass below";
    EXPECT_LE(app.simulation().tick(), 8u) << "ticks that lag are dropped";
    Input look_up = pressing(Key::MouseLook);
    look_up.dt_s = 10;
    look_up.mouse_delta_px = {0, -1e5f};
    play(app, look_up);
    EXPECT_EQ(app.settings().camera_pitch_deg, 90);
    EXPECT_TRUE(is_blue()) << "the sky, in the frame of the movement";
}

TEST_F(AppTest, StrokesPlaceRemoveUndoAndRedo) {
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    play(app, pressing(Key::Pause));
    play(app, pressing(Key::Digit1));
    play(app, clicking(MouseButton::Left));
    const std::uint64_t stone = count(app, MATERIAL_STONE);
    EXPECT_GT(stone, 10u);
    play(app, hands());
    play(app, clicking(MouseButton::Right));
    const std::uint64_t less = count(app, MATERIAL_STONE);
    EXPECT_LT(less, stone);
    play(app, pressing(Key::Undo));
    EXPECT_EQ(count(app, MATERIAL_STONE), stone);
    play(app, pressing(Key::Undo));
    EXPECT_EQ(count(app, MATERIAL_STONE), 0u);
    EXPECT_EQ(app.simulation().read_cells(), scene.cells);
    play(app, pressing(Key::Redo));
    play(app, pressing(Key::Redo));
    EXPECT_EQ(count(app, MATERIAL_STONE), less);
    EXPECT_EQ(app.simulation().tick(), 0u);
}

TEST_F(AppTest, AHeldButtonPoursWaterThatTheBooksKnow) {
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    Input input = clicking(MouseButton::Left);
    for (int i = 0; i < 10; ++i) {
        play(app, input);
        input.mouse_pressed = {};
    }
    const Census census = take_census(app.simulation().read_cells());
    const EditTotals& edits = app.simulation().edit_totals();
    EXPECT_GT(census.water_quanta, 16u * 33);
    EXPECT_EQ(census.water_quanta, edits.placed.water_quanta - edits.removed.water_quanta);
}

TEST_F(AppTest, MiddleClickTakesTheMaterialAndPlacesIt) {
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    const std::uint64_t grass = count(app, MATERIAL_GRASS);
    play(app, clicking(MouseButton::Middle));
    play(app, clicking(MouseButton::Left));
    EXPECT_GT(count(app, MATERIAL_GRASS), grass);
}

TEST_F(AppTest, AnEyeInWaterOrStoneKnowsWhereItIs) {
    Scene scene = meadow();
    for (int z = 0; z < 32; ++z)
        for (int y = 1; y < 15; ++y)
            for (int x = 0; x < 32; ++x)
                scene.cells.at({x, y, z}) = x < 16 ? MATERIAL_STONE : MATERIAL_WATER_FULL;
    gl::Timers timers;
    const Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    Settings settings = scene.settings;
    const auto pick = [&](glm::vec3 eye_vox, bool through_water) {
        settings.camera_position_vox = eye_vox;
        return renderer.pick(simulation, settings, size_px, glm::vec2(size_px) / 2.f, through_water);
    };
    const glm::ivec3 none(0);
    const glm::ivec3 up(0, 1, 0);

    const Pick in_stone = pick({8.5f, 12.5f, 16.5f}, true);
    EXPECT_TRUE(in_stone.hit);
    EXPECT_EQ(in_stone.cell, glm::ivec3(8, 12, 16));
    EXPECT_EQ(in_stone.normal, none);
    EXPECT_EQ(in_stone.byte, MATERIAL_STONE);
    const Pick in_water = pick({20.5f, 12.5f, 16.5f}, false);
    EXPECT_TRUE(in_water.hit);
    EXPECT_EQ(in_water.cell, glm::ivec3(20, 12, 16));
    EXPECT_EQ(in_water.normal, none);
    EXPECT_EQ(in_water.byte, MATERIAL_WATER_FULL);
    const Pick through = pick({20.5f, 12.5f, 16.5f}, true);
    EXPECT_TRUE(through.hit);
    EXPECT_EQ(through.cell, glm::ivec3(20, 0, 16));
    EXPECT_EQ(through.normal, up);
    EXPECT_EQ(through.byte, MATERIAL_GRASS);
    const Pick above = pick({20.5f, 15.5f, 16.5f}, false);
    EXPECT_EQ(above.cell, glm::ivec3(20, 14, 16));
    EXPECT_EQ(above.normal, up);
}

TEST_F(AppTest, OneBuildsUnderWaterAndDigsOneselfOutOfStone) {
    Scene scene = meadow();
    for (int z = 0; z < 32; ++z)
        for (int y = 1; y < 15; ++y)
            for (int x = 0; x < 32; ++x)
                scene.cells.at({x, y, z}) = x < 16 ? MATERIAL_STONE : MATERIAL_WATER_FULL;
    scene.settings.camera_position_vox.x = 24.5f;
    const std::uint64_t stone = take_census(scene.cells).voxels[MATERIAL_STONE];
    App diver(scene, scene.settings, interactive());
    play(diver, pressing(Key::Pause));
    play(diver, clicking(MouseButton::Middle));
    play(diver, clicking(MouseButton::Left));
    EXPECT_EQ(diver.simulation().read_cell({24, 1, 16}), MATERIAL_GRASS)
        << "taken from the ground, built on it";
    play(diver, hands());
    play(diver, pressing(Key::Digit1));
    play(diver, clicking(MouseButton::Left));
    EXPECT_GT(count(diver, MATERIAL_STONE), stone);

    scene.settings.camera_position_vox.x = 6.5f;
    App buried(scene, scene.settings, interactive());
    play(buried, pressing(Key::Pause));
    play(buried, clicking(MouseButton::Left));
    EXPECT_EQ(buried.simulation().read_cells(), scene.cells) << "nothing is placed from inside a voxel";
    play(buried, clicking(MouseButton::Right));
    EXPECT_EQ(buried.simulation().read_cell({6, 12, 16}), MATERIAL_AIR);
    EXPECT_LT(count(buried, MATERIAL_STONE), stone);
}

TEST_F(AppTest, PauseStepAndReload) {
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    play(app, hands());
    EXPECT_GT(app.simulation().tick(), 0u);
    play(app, pressing(Key::Pause));
    const std::uint64_t paused = app.simulation().tick();
    play(app, hands());
    EXPECT_EQ(app.simulation().tick(), paused);
    play(app, pressing(Key::Step));
    EXPECT_EQ(app.simulation().tick(), paused + 1);
    play(app, hands());
    EXPECT_EQ(app.simulation().tick(), paused + 1);
    play(app, clicking(MouseButton::Left));
    play(app, pressing(Key::Reset));
    EXPECT_EQ(app.simulation().tick(), 0u);
    EXPECT_EQ(app.simulation().read_cells(), scene.cells);
}

TEST_F(AppTest, AnotherSceneBringsItsCameraAndKeepsTheDisplay) {
    Scene scene = meadow();
    scene.settings.exposure_ev = 1.5f;
    App app(scene, scene.settings, interactive());
    play(app, hands());
    EXPECT_THROW(app.load("no-such-scene"), Error);
    EXPECT_EQ(app.simulation().read_cells().size_vox(), scene.cells.size_vox());
    app.load("furnace");
    play(app, hands());
    EXPECT_NE(app.simulation().size_vox(), scene.cells.size_vox());
    EXPECT_NE(app.settings().camera_position_vox, scene.settings.camera_position_vox);
    EXPECT_EQ(app.settings().exposure_ev, 1.5f);
    EXPECT_EQ(app.settings().quality, Quality::Fast);
}

TEST_F(AppTest, HeadlessRunsTicksPerFrameAndNoClock) {
    Scene scene = meadow();
    App still(scene, scene.settings, {});
    Input input;
    input.size_px = size_px;
    still.frame(input);
    EXPECT_EQ(still.simulation().tick(), 0u);
    scene.settings.ticks_per_frame = 3;
    App moving(scene, scene.settings, {});
    moving.frame(input);
    moving.frame(input);
    EXPECT_EQ(moving.simulation().tick(), 6u);
}

TEST_F(AppTest, AKeyShowsOneViewAfterAnotherAndKeepsTheHistory) {
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    play(app, pressing(Key::Pause));
    std::set<std::string> pictures;
    const auto seen = [&] {
        const ImageRgba8 picture = app.renderer().read_picture();
        return std::string(picture.pixels.begin(), picture.pixels.end());
    };
    const std::size_t count = choice_names<ViewKind>().size();
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(app.settings().view, static_cast<ViewKind>(i));
        EXPECT_TRUE(pictures.insert(seen()).second) << "a view that looks like another";
        play(app, pressing(Key::View));
    }
    EXPECT_EQ(app.settings().view, ViewKind::Picture);
    EXPECT_EQ(app.renderer().samples(), count + 1) << "every frame is kept";
    Input back = pressing(Key::View);
    back.down[static_cast<std::size_t>(Key::Fast)] = true;
    play(app, back);
    EXPECT_EQ(app.settings().view, ViewKind::Variance);
    play(app, back);
    EXPECT_EQ(app.settings().view, ViewKind::History);
}

TEST_F(AppTest, ARecordingPlaysFlightStrokesUndoAndRedoToTheSameWorld) {
    const Folder folder;
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    play(app, pressing(Key::Record));
    std::vector<glm::vec3> eyes;
    const auto make = [&](const Input& input) {
        play(app, input);
        eyes.push_back(app.settings().camera_position_vox);
    };
    make(hands());
    Input pour = clicking(MouseButton::Left);
    for (int i = 0; i < 5; ++i) {
        make(pour);
        pour.mouse_pressed = {};
    }
    Input move = hands();
    move.down[static_cast<std::size_t>(Key::Up)] = true;
    make(move);
    make(pressing(Key::Digit1));
    make(clicking(MouseButton::Left));
    make(hands());
    make(pressing(Key::Undo));
    make(pressing(Key::Undo));
    make(pressing(Key::Redo));
    for (int i = 0; i < 5; ++i) make(hands());
    const Cells at_end = app.simulation().read_cells();
    EXPECT_GT(take_census(at_end).water_quanta, 0u);
    play(app, pressing(Key::Record));  // ends before the frame's own ticks
    const Recording recording = load_recording("tarn-0001.flight.json");
    ASSERT_EQ(recording.frames(), static_cast<int>(eyes.size()) + 1);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    EditHistory history;
    Settings settings = scene.settings;
    for (int frame = 1; frame < recording.frames(); ++frame) {
        place_camera(recording, frame, scene.settings, settings);
        EXPECT_EQ(settings.camera_position_vox, eyes[static_cast<std::size_t>(frame) - 1]) << frame;
    }
    for (int frame = 0; frame < recording.frames(); ++frame)
        play_world(recording, frame, scene.settings, simulation, settings, history);
    EXPECT_EQ(simulation.read_cells(), at_end);
    // Another world ends a recording: its file is the next.
    play(app, pressing(Key::Record));
    play(app, hands());
    play(app, pressing(Key::Reset));
    EXPECT_TRUE(std::filesystem::exists("tarn-0002.flight.json"));
}

TEST_F(AppTest, UndoOfAPourTakesWhatFlowedOnAndRedoGivesItBack) {
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    Input pour = clicking(MouseButton::Left);
    for (int i = 0; i < 10; ++i) {
        play(app, pour);
        pour.mouse_pressed = {};
    }
    play(app, pressing(Key::Pause));
    for (int i = 0; i < 40; ++i) play(app, pressing(Key::Step));
    const std::uint64_t poured = take_census(app.simulation().read_cells()).water_quanta;
    EXPECT_GT(poured, 16u * 33);
    const auto books = [&] {
        const EditTotals& edits = app.simulation().edit_totals();
        return edits.placed.water_quanta - edits.removed.water_quanta;
    };
    for (int again = 0; again < 3; ++again) {
        play(app, pressing(Key::Undo));
        EXPECT_EQ(take_census(app.simulation().read_cells()).water_quanta, 0u) << "all of " << poured;
        EXPECT_EQ(app.simulation().read_cells(), scene.cells);
        EXPECT_EQ(books(), 0u);
        play(app, pressing(Key::Redo));
        EXPECT_EQ(take_census(app.simulation().read_cells()).water_quanta, poured);
        EXPECT_EQ(books(), poured);
        for (int i = 0; i < 10; ++i) play(app, pressing(Key::Step));
    }
}

TEST_F(AppTest, TheGroundStopsTheEyeUnlessAskedAndHomeBringsItBack) {
    const auto sink = [](App& app) {
        Input down = hands(0.25);
        down.down[static_cast<std::size_t>(Key::Down)] = true;
        for (int i = 0; i < 20; ++i) play(app, down);
        return app.settings().camera_position_vox;
    };
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    play(app, pressing(Key::Pause));
    EXPECT_NEAR(sink(app).y, 1.25f, 1e-3f) << "a quarter of a voxel above the grass";
    play(app, pressing(Key::Home));
    EXPECT_EQ(app.settings().camera_position_vox, scene.settings.camera_position_vox);
    EXPECT_EQ(app.settings().camera_pitch_deg, scene.settings.camera_pitch_deg);
    scene.settings.fly_through_ground = true;
    App ghost(scene, scene.settings, interactive());
    EXPECT_LT(sink(ghost).y, 0);
}

TEST_F(AppTest, PicturesNeverOverwriteOneAnother) {
    const Folder folder;
    Scene scene = meadow();
    App app(scene, scene.settings, interactive());
    play(app, pressing(Key::Screenshot));
    play(app, pressing(Key::Screenshot));
    for (const char* name : {"tarn-0001.png", "tarn-0001.json", "tarn-0002.png", "tarn-0002.json"})
        EXPECT_TRUE(std::filesystem::exists(name)) << name;
    EXPECT_EQ(read_png("tarn-0001.png").width, size_px.x);
}

}  // namespace
}  // namespace tarn
