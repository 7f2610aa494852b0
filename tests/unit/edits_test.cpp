#include "world/edits.h"

#include <gtest/gtest.h>

#include <limits>

#include "shared/hash.h"

namespace tarn {
namespace {

// A world with a bit of everything, water of all amounts included.
Cells mixed_world(glm::ivec3 size, std::uint32_t seed) {
    constexpr std::uint8_t bytes[] = {0, 0, 1, 4, 8, 64, 70, 79, 80};
    Cells cells(size);
    for (std::size_t i = 0; i < cells.count(); ++i)
        cells.bytes()[i] = bytes[hash2(seed, static_cast<std::uint32_t>(i)) % std::size(bytes)];
    return cells;
}

std::vector<std::uint8_t> region_of(const Cells& cells, const Box& box) {
    std::vector<std::uint8_t> region;
    for (int z = box.min_vox.z; z < box.max_vox.z; ++z) {
        for (int y = box.min_vox.y; y < box.max_vox.y; ++y) {
            for (int x = box.min_vox.x; x < box.max_vox.x; ++x) region.push_back(cells.at({x, y, z}));
        }
    }
    return region;
}

void put_region(Cells& cells, const Box& box, const std::vector<std::uint8_t>& region) {
    std::size_t i = 0;
    for (int z = box.min_vox.z; z < box.max_vox.z; ++z) {
        for (int y = box.min_vox.y; y < box.max_vox.y; ++y) {
            for (int x = box.min_vox.x; x < box.max_vox.x; ++x) cells.at({x, y, z}) = region[i++];
        }
    }
}

void apply(Cells& cells, const Edit& edit, EditTotals& totals, EditHistory* history) {
    const Box bounds = bounds_of(edit, cells.size_vox());
    const auto before = region_of(cells, bounds);
    auto after = before;
    const bool changed = apply_edit(edit, bounds, after, totals);
    EXPECT_EQ(changed, before != after);
    put_region(cells, bounds, after);
    if (history != nullptr) history->record(edit, bounds, before, after);
}

void write(Cells& cells, const std::vector<CellChange>& changes) {
    for (const CellChange& change : changes) {
        EXPECT_EQ(cells.at(change.cell), change.before);
        cells.at(change.cell) = change.after;
    }
}

// Edits of every shape and kind, some beyond the world's ends.
Edit some_edit(std::uint32_t seed, std::uint32_t i, glm::ivec3 size) {
    constexpr std::uint8_t materials[] = {MATERIAL_AIR, MATERIAL_WATER, MATERIAL_SAND, MATERIAL_STONE};
    Edit edit;
    edit.tick = i / 3;
    edit.shape = hash3(seed, i, 0) % 2 == 0 ? BrushShape::Sphere : BrushShape::Cube;
    for (int axis = 0; axis < 3; ++axis)
        edit.center_vox[axis] = static_cast<int>(hash3(seed, i, 1 + axis) % (size[axis] + 4)) - 2;
    edit.radius_vox = static_cast<int>(hash3(seed, i, 4) % 5);
    edit.material = materials[hash3(seed, i, 5) % 4];
    edit.overwrite = hash3(seed, i, 6) % 2 == 0;
    return edit;
}

TEST(Edits, ASphereOfRadiusRHoldsCellsWithinRAndAHalf) {
    for (const int radius : {0, 1, 2, 5}) {
        Edit edit{.center_vox = {8, 8, 8}, .radius_vox = radius, .material = MATERIAL_STONE};
        Cells cells({17, 17, 17});
        EditTotals totals;
        apply(cells, edit, totals, nullptr);
        for (int z = 0; z < 17; ++z) {
            for (int y = 0; y < 17; ++y) {
                for (int x = 0; x < 17; ++x) {
                    const double distance = glm::length(glm::dvec3(x - 8, y - 8, z - 8));
                    EXPECT_EQ(cells.at({x, y, z}) == MATERIAL_STONE, distance <= radius + 0.5)
                        << radius << ": " << x << " " << y << " " << z;
                }
            }
        }
    }
}

TEST(Edits, ACubeOfRadiusRIsTwiceRPlusOneWide) {
    const Edit edit{
        .shape = BrushShape::Cube, .center_vox = {8, 8, 8}, .radius_vox = 2, .material = MATERIAL_SAND};
    Cells cells({17, 17, 17});
    EditTotals totals;
    apply(cells, edit, totals, nullptr);
    EXPECT_EQ(take_census(cells).voxels[MATERIAL_SAND], 125u);
    EXPECT_EQ(totals.placed.voxels[MATERIAL_SAND], 125u);
}

TEST(Edits, BoundsAreClippedAndEmptyWhereTheBrushMisses) {
    const glm::ivec3 size(10, 7, 3);
    Edit edit{.center_vox = {0, 6, 1}, .radius_vox = 2};
    EXPECT_EQ(bounds_of(edit, size), (Box{{0, 4, 0}, {3, 7, 3}}));
    edit.radius_vox = 0;
    EXPECT_EQ(bounds_of(edit, size), (Box{{0, 6, 1}, {1, 7, 2}}));
    for (const glm::ivec3 outside : {glm::ivec3(-1, 0, 0), glm::ivec3(10, 0, 0), glm::ivec3(0, 0, 3)}) {
        edit.center_vox = outside;
        EXPECT_EQ(bounds_of(edit, size).volume(), 0u);
    }
    constexpr int far = std::numeric_limits<int>::max();
    edit = {.center_vox = {far, far, -far}, .radius_vox = far};
    EXPECT_EQ(bounds_of(edit, size).volume(), size.x * size.y * 1u) << "only the layer z = 0 is that near";
    EditTotals totals;
    Cells cells(size);
    edit.material = MATERIAL_STONE;
    apply(cells, edit, totals, nullptr);
    EXPECT_EQ(take_census(cells).voxels[MATERIAL_STONE], 0u) << "its corner lies outside the sphere";
}

TEST(Edits, PlacingFillsAirAndWaterAndOnlyOverwritesOnDemand) {
    Cells cells({6, 1, 1});
    cells.bytes() = {MATERIAL_AIR, 66, MATERIAL_SAND, MATERIAL_STONE, MATERIAL_WATER_FULL, 80};
    Edit edit{
        .shape = BrushShape::Cube, .center_vox = {3, 0, 0}, .radius_vox = 5, .material = MATERIAL_WATER};
    EditTotals totals;
    apply(cells, edit, totals, nullptr);
    EXPECT_EQ(cells.bytes(), (std::vector<std::uint8_t>{79, 79, MATERIAL_SAND, MATERIAL_STONE, 79, 80}));
    EXPECT_EQ(totals.placed.water_quanta, 32u);
    EXPECT_EQ(totals.removed.water_quanta, 3u) << "replaced water is removed water";
    EXPECT_EQ(totals.placed.voxels[MATERIAL_WATER], 2u) << "a full voxel stays and counts nowhere";
    edit.overwrite = true;
    edit.material = MATERIAL_GLASS;
    apply(cells, edit, totals, nullptr);
    EXPECT_EQ(take_census(cells).voxels[MATERIAL_GLASS], 6u);
    edit.material = MATERIAL_AIR;
    edit.overwrite = false;
    apply(cells, edit, totals, nullptr);
    EXPECT_EQ(take_census(cells).voxels[MATERIAL_AIR], 6u)
        << "removing takes solids whatever `overwrite` says";
}

TEST(Edits, BeforePlusPlacedMinusRemovedIsAfter) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        Cells cells = mixed_world({13, 9, 11}, seed);
        const Census before = take_census(cells);
        EditTotals totals;
        for (std::uint32_t i = 0; i < 60; ++i)
            apply(cells, some_edit(seed, i, cells.size_vox()), totals, nullptr);
        const Census after = take_census(cells);
        EXPECT_NE(before, after);
        for (std::size_t id = 0; id < MATERIAL_COUNT; ++id)
            EXPECT_EQ(before.voxels[id] + totals.placed.voxels[id] - totals.removed.voxels[id],
                      after.voxels[id])
                << id;
        EXPECT_EQ(before.water_quanta + totals.placed.water_quanta - totals.removed.water_quanta,
                  after.water_quanta);
    }
}

TEST(Edits, UndoAndRedoRestoreEveryByte) {
    Cells cells = mixed_world({13, 9, 11}, 9);
    EditHistory history;
    EditTotals totals;
    std::vector<Cells> states{cells};
    std::uint32_t i = 0;
    for (int stroke = 0; stroke < 12; ++stroke) {
        history.begin_stroke();
        // Edits of one stroke overlap: undone in the wrong order they would leave traces.
        for (int n = 0; n <= stroke % 4; ++n)
            apply(cells, some_edit(9, i++, cells.size_vox()), totals, &history);
        if (states.back() != cells) states.push_back(cells);
    }
    ASSERT_GT(states.size(), 6u);
    for (std::size_t k = states.size() - 1; k > 0; --k) {
        ASSERT_TRUE(history.can_undo());
        write(cells, *history.undo());
        EXPECT_EQ(cells, states[k - 1]) << k;
    }
    EXPECT_FALSE(history.can_undo());
    EXPECT_EQ(history.undo(), std::nullopt);
    for (std::size_t k = 1; k < states.size(); ++k) {
        write(cells, *history.redo());
        EXPECT_EQ(cells, states[k]) << k;
    }
    EXPECT_FALSE(history.can_redo());
    EXPECT_EQ(history.redo(), std::nullopt);
}

TEST(Edits, ReplayingTheLogGivesTheSameCells) {
    const Cells start = mixed_world({20, 6, 9}, 4);
    Cells cells = start;
    EditHistory history;
    EditTotals totals;
    for (std::uint32_t i = 0; i < 40; ++i) {
        if (i % 4 == 0) history.begin_stroke();
        apply(cells, some_edit(4, i, cells.size_vox()), totals, &history);
    }
    ASSERT_EQ(history.log().size(), 40u);
    Cells again = start;
    EditTotals totals_again;
    for (const Edit& edit : history.log()) apply(again, edit, totals_again, nullptr);
    EXPECT_EQ(again, cells);
    EXPECT_EQ(totals_again, totals);
}

TEST(Edits, ANewStrokeEndsRedoAndAnEmptyOneIsNotKept) {
    Cells cells({5, 5, 5});
    EditHistory history;
    EditTotals totals;
    const Edit stone{.center_vox = {2, 2, 2}, .radius_vox = 1, .material = MATERIAL_STONE};
    history.begin_stroke();
    apply(cells, stone, totals, &history);
    history.begin_stroke();
    apply(cells, stone, totals, &history);  // nothing left to change
    write(cells, *history.undo());
    EXPECT_EQ(cells, Cells({5, 5, 5}));
    EXPECT_FALSE(history.can_undo());
    EXPECT_TRUE(history.can_redo());
    history.begin_stroke();
    EXPECT_FALSE(history.can_redo());
    history.clear();
    EXPECT_TRUE(history.log().empty());
}

TEST(Edits, HistoryKeepsTheYoungestStrokesWithin64MiB) {
    // Strokes of 2^20 changes are 16 MiB each: four fit, a fifth drops the first.
    const Box bounds{{0, 0, 0}, {256, 64, 64}};
    const std::vector<std::uint8_t> off(bounds.volume(), 0);
    const std::vector<std::uint8_t> on(bounds.volume(), 1);
    static_assert(sizeof(CellChange) == 16);
    EditHistory history;
    for (int stroke = 0; stroke < 5; ++stroke) {
        history.begin_stroke();
        history.record({}, bounds, stroke % 2 == 0 ? off : on, stroke % 2 == 0 ? on : off);
    }
    int undone = 0;
    while (auto changes = history.undo()) {
        EXPECT_EQ(changes->size(), bounds.volume());
        ++undone;
    }
    EXPECT_EQ(undone, 4);
    // A single stroke beyond the cap goes as a whole, and the rest of it is not half kept.
    history.clear();
    history.begin_stroke();
    for (int edit = 0; edit < 6; ++edit) history.record({}, bounds, off, on);
    EXPECT_FALSE(history.can_undo());
    history.begin_stroke();
    history.record({}, bounds, off, on);
    EXPECT_TRUE(history.can_undo());
    EXPECT_EQ(history.log().size(), 7u);
}

std::int64_t water_in(const std::vector<std::uint8_t>& bytes) {
    std::int64_t quanta = 0;
    for (const std::uint8_t byte : bytes) quanta += quanta_of(byte);
    return quanta;
}

TEST(Edits, WhatAStrokePouredIsTakenBackWhereItFlowed) {
    // A pond of two cells in a row of ten, a stroke at the other end that filled its cell three times.
    const Box row{{0, 0, 0}, {10, 1, 1}};
    const auto water = [](int quanta) { return static_cast<std::uint8_t>(63 + quanta); };
    const std::vector<CellChange> undone = {{{9, 0, 0}, water(16), water(9)},
                                            {{9, 0, 0}, water(16), water(4)},
                                            {{9, 0, 0}, water(16), MATERIAL_AIR}};
    const std::int64_t poured = 16 + 12 + 7;
    const std::vector<std::uint8_t> pond = {water(16), water(16), 0, 0, 0, 0, 0, 0, 0, 0};
    std::vector<std::uint8_t> now = {water(16), water(16), water(1), water(3), water(4),
                                     0,         water(5),  water(6), water(7), water(9)};
    ASSERT_EQ(water_in(now), water_in(pond) + poured);
    std::vector<std::uint8_t> written = now;
    written[9] = MATERIAL_AIR;
    const auto taken = flowed_on(undone, row, now, written);
    for (const CellChange& change : taken) {
        EXPECT_EQ(change.before, written[change.cell.x]);
        written[change.cell.x] = change.after;
    }
    EXPECT_EQ(written, pond) << "all of it, the nearest first";
    // Behind stone it is out of reach, and so stays.
    now[5] = MATERIAL_STONE;
    written = now;
    written[9] = MATERIAL_AIR;
    std::int64_t quanta = 0;
    for (const CellChange& change : flowed_on(undone, row, now, written)) {
        EXPECT_GT(change.cell.x, 5);
        quanta += static_cast<std::int64_t>(quanta_of(change.before)) - quanta_of(change.after);
    }
    EXPECT_EQ(quanta, 5 + 6 + 7);
    // A stroke that took water gives none to take.
    EXPECT_TRUE(flowed_on({{{9, 0, 0}, MATERIAL_AIR, water(16)}}, row, pond, pond).empty());
    EXPECT_TRUE(flowed_on({{{9, 0, 0}, MATERIAL_STONE, MATERIAL_AIR}}, row, pond, pond).empty());
}

TEST(Edits, PouredSandIsTakenBackFromItsHeap) {
    const Box column{{0, 0, 0}, {1, 6, 1}};
    const std::vector<CellChange> undone = {{{0, 5, 0}, MATERIAL_SAND, MATERIAL_AIR},
                                            {{0, 5, 0}, MATERIAL_SAND, MATERIAL_AIR}};
    const std::vector<std::uint8_t> now = {MATERIAL_STONE, MATERIAL_SAND, MATERIAL_SAND, MATERIAL_SAND, 0, 0};
    const auto taken = flowed_on(undone, column, now, now);
    ASSERT_EQ(taken.size(), 2u);
    EXPECT_EQ(taken[0], (CellChange{{0, 3, 0}, MATERIAL_SAND, MATERIAL_AIR}));
    EXPECT_EQ(taken[1], (CellChange{{0, 2, 0}, MATERIAL_SAND, MATERIAL_AIR}));
}

TEST(Edits, RedoGivesBackWhatUndoTookAndNoMore) {
    // Of 35 quanta the undo found 9 in the stroke's cell and 26 elsewhere; writing the cell again makes 16.
    const Box row{{0, 0, 0}, {4, 1, 1}};
    const auto water = [](int quanta) { return static_cast<std::uint8_t>(63 + quanta); };
    const Taken taken{{{{0, 0, 0}, water(16), MATERIAL_AIR}, {{1, 0, 0}, water(12), water(2)}}, {35, 0}};
    const auto apply = [](std::vector<std::uint8_t> bytes, const std::vector<CellChange>& changes) {
        for (const CellChange& change : changes) {
            EXPECT_EQ(bytes[change.cell.x], change.before);
            bytes[change.cell.x] = change.after;
        }
        return bytes;
    };
    const std::vector<std::uint8_t> now = {MATERIAL_AIR, water(2), MATERIAL_AIR, water(16)};
    EXPECT_EQ(apply(now, given_back(taken, {16, 0}, row, now)),
              (std::vector<std::uint8_t>{water(16), water(5), MATERIAL_AIR, water(16)}));
    // All that was poured has been written again: nothing is left to give.
    EXPECT_TRUE(given_back(taken, {35, 0}, row, now).empty());
    EXPECT_TRUE(given_back(taken, {48, 0}, row, now).empty());
    // What has come since keeps its place.
    const std::vector<std::uint8_t> since = {MATERIAL_STONE, water(11), MATERIAL_AIR, water(16)};
    EXPECT_EQ(apply(since, given_back(taken, {16, 0}, row, since)),
              (std::vector<std::uint8_t>{MATERIAL_STONE, water(16), MATERIAL_AIR, water(16)}));
    const Taken heap{{{{2, 0, 0}, MATERIAL_SAND, MATERIAL_AIR}, {{3, 0, 0}, MATERIAL_SAND, MATERIAL_AIR}},
                     {0, 2}};
    EXPECT_EQ(apply(since, given_back(heap, {0, 0}, row, since)),
              (std::vector<std::uint8_t>{MATERIAL_STONE, water(11), MATERIAL_SAND, water(16)}));
}

TEST(Edits, WhatUndoTookIsKeptForOneRedo) {
    EditHistory history;
    history.begin_stroke();
    history.record({.material = MATERIAL_WATER}, {{3, 3, 3}, {4, 4, 4}}, {MATERIAL_AIR},
                   {MATERIAL_WATER_FULL});
    EXPECT_EQ(history.release_taken().in_all.quanta, 0);
    ASSERT_EQ(history.undo()->size(), 1u);
    history.took({{{{3, 2, 3}, MATERIAL_WATER_FULL, MATERIAL_AIR}}, {16, 0}});
    EXPECT_EQ(history.release_taken().in_all.quanta, 16);
    EXPECT_TRUE(history.release_taken().elsewhere.empty());
    EXPECT_EQ(history.redo()->size(), 1u);
}

}  // namespace
}  // namespace tarn
