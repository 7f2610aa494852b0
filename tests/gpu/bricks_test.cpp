// What rays skip by equals a count over the cells, after loading, ticks and edits; and exactly
// the bricks whose cells changed are stamped.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "app/simulation.h"
#include "brick_rooms.h"
#include "core/error.h"
#include "gpu/gl_test.h"
#include "gpu/worlds.h"
#include "shared/bindings.h"

namespace tarn {
namespace {

using BricksTest = GlTest;

glm::ivec3 bricks_in(glm::ivec3 size_vox) {
    return (size_vox + BRICK_SIDE - 1) / BRICK_SIDE;
}

template <typename Act>
void for_cells(glm::ivec3 size, const Act& act) {
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) act(glm::ivec3(x, y, z));
}

int flat(glm::ivec3 at, glm::ivec3 size) {
    return at.x + size.x * (at.y + size.y * at.z);
}

std::size_t volume(glm::ivec3 size) {
    return std::size_t{1} * size.x * size.y * size.z;
}

void expect_right_rooms(const Simulation& simulation, const Cells& cells) {
    const BrickRooms counted(cells);
    const glm::ivec3 size = counted.size();
    ASSERT_EQ(simulation.brick_rooms().size(), size);
    std::vector<glm::uvec2> got(volume(size));
    simulation.brick_rooms().download(std::span(got), GL_RG_INTEGER, GL_UNSIGNED_INT);
    for_cells(size, [&](glm::ivec3 brick) {
        const glm::uvec2 word = got[flat(brick, size)];
        const glm::uvec2 right = counted.words()[flat(brick, size)];
        ASSERT_EQ(word, right) << fmt::format("brick ({}, {}, {}): GPU {:x} {:x}, counted {:x} {:x}", brick.x,
                                              brick.y, brick.z, word.x, word.y, right.x, right.y);
    });
}

// The bricks in which `before` and `after` differ are stamped with the simulation's version; no others are.
void expect_right_stamps(const Simulation& simulation, const Cells& before, const Cells& after) {
    const glm::ivec3 size = bricks_in(before.size_vox());
    std::vector<std::uint32_t> stamps(volume(size));
    simulation.brick_changed().download(std::span<std::uint32_t>(stamps), GL_RED_INTEGER, GL_UNSIGNED_INT);
    std::vector<char> changed(stamps.size(), 0);
    for_cells(before.size_vox(), [&](glm::ivec3 cell) {
        if (before.at(cell) != after.at(cell)) changed[flat(cell / BRICK_SIDE, size)] = 1;
    });
    for (std::size_t i = 0; i < stamps.size(); ++i)
        ASSERT_EQ(stamps[i] == static_cast<std::uint32_t>(simulation.version()), changed[i] != 0)
            << "brick " << i;
}

Scene sparse_scene(glm::ivec3 size_vox) {
    Scene scene;
    scene.cells = Cells(size_vox);
    const glm::ivec3 high = glm::max(size_vox * 3 / 4, glm::ivec3(1)) - 1;
    scene.cells.at(high) = MATERIAL_WATER_FULL;
    scene.cells.at({high.x, high.y, 0}) = MATERIAL_SAND;
    return scene;
}

TEST_F(BricksTest, rooms_equal_a_count_as_things_move) {
    for (const glm::ivec3 size :
         {glm::ivec3(1, 1, 1), glm::ivec3(7, 13, 5), glm::ivec3(61, 37, 45), glm::ivec3(64, 48, 64),
          glm::ivec3(530, 20, 9), glm::ivec3(8, 300, 3), glm::ivec3(5, 9, 270)}) {
        SCOPED_TRACE(fmt::format("{}x{}x{}", size.x, size.y, size.z));
        const Scene scene = sparse_scene(size);
        gl::Timers timers;
        Simulation simulation(scene, timers);
        expect_right_rooms(simulation, scene.cells);
        Cells before = scene.cells;
        for (int i = 0; i < 12; ++i) {
            simulation.step(1, Settings{});
            const Cells after = simulation.read_cells();
            expect_right_stamps(simulation, before, after);
            if (i % 3 == 0) expect_right_rooms(simulation, after);
            if (HasFatalFailure()) return;
            before = after;
        }
        simulation.step(20, Settings{});
        expect_right_rooms(simulation, simulation.read_cells());
    }
}

TEST_F(BricksTest, rooms_of_water_end_at_the_worlds_border_and_at_cut_bricks) {
    for (const glm::ivec3 size : {glm::ivec3(64, 64, 64), glm::ivec3(61, 64, 64), glm::ivec3(72, 40, 56)}) {
        Scene scene;
        scene.cells = Cells(size);
        std::fill(scene.cells.bytes().begin(), scene.cells.bytes().end(),
                  static_cast<std::uint8_t>(MATERIAL_WATER_FULL));
        gl::Timers timers;
        Simulation simulation(scene, timers);
        expect_right_rooms(simulation, scene.cells);
        Cells holed = scene.cells;
        holed.at({20, 20, 20}) = water_cell(15);
        simulation.write_cells(holed);
        expect_right_rooms(simulation, holed);
    }
}

TEST_F(BricksTest, edits_undo_and_loading_keep_them_right) {
    const Scene scene = sparse_scene({61, 37, 45});
    gl::Timers timers;
    Simulation simulation(scene, timers);
    EditHistory history;
    Cells before = scene.cells;
    const auto look = [&] {
        const Cells after = simulation.read_cells();
        expect_right_stamps(simulation, before, after);
        expect_right_rooms(simulation, after);
        before = after;
    };
    const Edit edits[] = {
        {.center_vox = {30, 20, 20}, .radius_vox = 9, .material = MATERIAL_WATER},
        {.center_vox = {60, 36, 44}, .radius_vox = 4, .material = MATERIAL_STONE},
        {.shape = BrushShape::Cube, .center_vox = {5, 5, 5}, .radius_vox = 7, .material = MATERIAL_SAND},
        {.center_vox = {30, 20, 20}, .radius_vox = 12, .material = MATERIAL_AIR},
        {.center_vox = {-90, 20, 20}, .radius_vox = 12, .material = MATERIAL_STONE},
    };
    for (const Edit& edit : edits) {
        history.begin_stroke();
        const std::uint64_t version = simulation.version();
        simulation.apply(edit, history);
        EXPECT_EQ(simulation.version() > version, edit.center_vox.x >= 0);
        if (simulation.version() > version) look();
    }
    EXPECT_NE(hash_of(before), hash_of(scene.cells));
    while (const auto changes = history.undo()) {
        simulation.write(*changes);
        look();
        if (HasFatalFailure()) return;
    }
    EXPECT_TRUE(same_cells(before, scene.cells)) << "undo leads back";
    const auto redo = history.redo();
    ASSERT_TRUE(redo.has_value());
    simulation.write(*redo);
    look();
}

// Two small edits far apart are one stroke: undo goes brick by brick, not through all that lies between.
TEST_F(BricksTest, a_stroke_across_the_world_is_undone) {
    const Scene scene = sparse_scene({61, 37, 45});
    gl::Timers timers;
    Simulation simulation(scene, timers);
    EditHistory history;
    history.begin_stroke();
    for (const glm::ivec3 center : {glm::ivec3(1, 1, 1), glm::ivec3(60, 36, 44), glm::ivec3(1, 1, 2)})
        simulation.apply(
            {.center_vox = center, .radius_vox = 1, .material = MATERIAL_WALL, .overwrite = true}, history);
    const Cells edited = simulation.read_cells();
    const auto undo = history.undo();
    ASSERT_TRUE(undo.has_value());
    ASSERT_LT(undo->size(), 100u);
    simulation.write(*undo);
    expect_right_stamps(simulation, edited, scene.cells);
    expect_right_rooms(simulation, scene.cells);
    EXPECT_TRUE(same_cells(simulation.read_cells(), scene.cells));
    EXPECT_EQ(simulation.edit_totals().placed, simulation.edit_totals().removed);
    simulation.write(*history.redo());
    EXPECT_TRUE(same_cells(simulation.read_cells(), edited));
}

// Worlds that reach farther than the largest distance, so that only a part is computed anew: all around open
// sky, in deep water and at the borders.
TEST_F(BricksTest, distances_follow_random_edits_and_what_moves) {
    std::mt19937 random(5);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (const glm::ivec3 size : {glm::ivec3(300, 290, 310), glm::ivec3(700, 21, 16), glm::ivec3(9, 700, 24),
                                  glm::ivec3(16, 33, 700)}) {
        SCOPED_TRACE(fmt::format("{}x{}x{}", size.x, size.y, size.z));
        Scene scene;
        scene.cells = Cells(size);
        auto& bytes = scene.cells.bytes();
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; 2 * y < size.y; ++y)
                std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(scene.cells.index({0, y, z})), size.x,
                            static_cast<std::uint8_t>(MATERIAL_WATER_FULL));
        gl::Timers timers;
        Simulation simulation(scene, timers);
        simulation.put_to_sleep();
        EditHistory history;
        constexpr std::array<std::uint8_t, 4> materials{MATERIAL_STONE, MATERIAL_AIR, MATERIAL_WATER,
                                                        MATERIAL_SAND};
        // Five hold an undo and ticks as well; a count over the largest world takes a second.
        const int rounds = volume(size) > 1'000'000 ? 5 : 12;
        for (int round = 0; round < rounds; ++round) {
            history.begin_stroke();
            // The first a stone in the sky, alone; then, two at a time, one at each end of what came before.
            for (int i = 0; i < (round == 0 ? 1 : 2); ++i)
                simulation.apply({.tick = simulation.tick(),
                                  .center_vox = {below(size.x), round == 0 ? size.y * 3 / 4 : below(size.y),
                                                 below(size.z)},
                                  .radius_vox = 1 + below(9),
                                  .material = materials[static_cast<std::size_t>(round % 4)],
                                  .overwrite = true},
                                 history);
            if (round % 3 == 2) simulation.write(*history.undo());
            if (round % 4 == 3) simulation.step(1 + below(3), Settings{});
            expect_right_rooms(simulation, simulation.read_cells());
            if (HasFatalFailure()) return;
        }
    }
}

TEST_F(BricksTest, single_cells_are_read_back) {
    Scene scene;
    scene.cells = make_soup({7, 13, 5}, Soup::AllBytes, 3);
    gl::Timers timers;
    const Simulation simulation(scene, timers);
    for_cells({7, 13, 5},
              [&](glm::ivec3 cell) { ASSERT_EQ(simulation.read_cell(cell), scene.cells.at(cell)); });
}

TEST_F(BricksTest, a_world_beyond_the_drivers_limits_is_an_error) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
    Scene scene;
    scene.cells = Cells({most + 1, 1, 1});
    gl::Timers timers;
    EXPECT_THROW(Simulation(scene, timers), Error);
}

}  // namespace
}  // namespace tarn
