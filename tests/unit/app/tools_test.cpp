#include "app/tools.h"

#include <gtest/gtest.h>

namespace tarn {
namespace {

constexpr Ray down_ray{{5.5f, 10, 5.5f}, {0, -1, 0}};
constexpr Pick floor_pick{.hit = true, .cell = {5, 0, 5}, .normal = {0, 1, 0}, .byte = MATERIAL_STONE};

Input frame(double dt_s = 0.1) {
    Input input;
    input.dt_s = dt_s;
    input.mouse_on_picture = true;
    return input;
}

Input with_button(MouseButton button, bool pressed_now, double dt_s = 0.1) {
    Input input = frame(dt_s);
    input.mouse_down[static_cast<std::size_t>(button)] = true;
    input.mouse_pressed[static_cast<std::size_t>(button)] = pressed_now;
    return input;
}

Input with_key(Key key) {
    Input input = frame();
    input.pressed[static_cast<std::size_t>(key)] = true;
    return input;
}

Ray towards(glm::vec3 point) {
    return {down_ray.origin, glm::normalize(point - down_ray.origin)};
}

TEST(Tools, TargetIsBeforeTheFaceToPlaceAndTheCellToRemove) {
    EXPECT_EQ(target_cell(floor_pick, true, down_ray.origin), glm::ivec3(5, 1, 5));
    EXPECT_EQ(target_cell(floor_pick, false, down_ray.origin), glm::ivec3(5, 0, 5));
    EXPECT_FALSE(target_cell(Pick{}, true, down_ray.origin)) << "nothing hit";
    EXPECT_FALSE(target_cell(floor_pick, true, {5, 500, 5})) << "out of reach";
    Pick inside = floor_pick;
    inside.normal = glm::ivec3(0);
    EXPECT_FALSE(target_cell(inside, true, {5.5f, 0.5f, 5.5f}));
    EXPECT_TRUE(target_cell(inside, false, {5.5f, 0.5f, 5.5f}));
}

TEST(Tools, NumberKeysWheelAndShape) {
    Tools tools;
    tools.choose(with_key(Key::Digit1));
    EXPECT_EQ(tools.brush.material, MATERIAL_STONE);
    EXPECT_TRUE(tools.brush.goes_through_water());
    tools.choose(with_key(Key::Digit9));
    EXPECT_EQ(tools.brush.material, MATERIAL_WATER);
    EXPECT_FALSE(tools.brush.goes_through_water());
    tools.choose(with_key(Key::Brush));
    EXPECT_EQ(tools.brush.shape, BrushShape::Cube);
    tools.choose(with_key(Key::Overwrite));
    EXPECT_TRUE(tools.brush.overwrite);
    Input wheel = frame();
    wheel.wheel = 1e9f;
    tools.choose(wheel);
    EXPECT_EQ(tools.brush.radius_vox, brush_radius_max_vox);
    wheel.wheel = -40;
    tools.choose(wheel);
    EXPECT_EQ(tools.brush.radius_vox, 0);
    wheel.wheel = 0.5f;
    tools.choose(wheel);
    EXPECT_EQ(tools.brush.radius_vox, 0);
    tools.choose(wheel);
    EXPECT_EQ(tools.brush.radius_vox, 1) << "two half steps";
}

TEST(Tools, TakesNamedMaterialsOnly) {
    Tools tools;
    tools.take_material(floor_pick);
    EXPECT_EQ(tools.brush.material, MATERIAL_STONE);
    Pick other = floor_pick;
    other.byte = MATERIAL_WATER + 7;
    tools.take_material(other);
    EXPECT_EQ(tools.brush.material, MATERIAL_WATER);
    other.byte = 200;
    tools.take_material(other);
    EXPECT_EQ(tools.brush.material, MATERIAL_WATER);
    tools.take_material(Pick{});
    EXPECT_EQ(tools.brush.material, MATERIAL_WATER);
}

TEST(Tools, ASolidIsPlacedOncePerSpotAndStaysInItsPlane) {
    Tools tools;
    tools.brush = {.material = MATERIAL_STONE, .radius_vox = 0};
    auto stroke = tools.use(with_button(MouseButton::Left, true), floor_pick, down_ray, 7);
    ASSERT_EQ(stroke.edits.size(), 1u);
    EXPECT_TRUE(stroke.begins);
    EXPECT_EQ(stroke.edits[0].center_vox, glm::ivec3(5, 1, 5));
    EXPECT_EQ(stroke.edits[0].tick, 7u);
    EXPECT_EQ(stroke.edits[0].material, MATERIAL_STONE);
    EXPECT_FALSE(tools.needs_pick(with_button(MouseButton::Left, false)));

    // What was just placed lies under the pointer now.
    Pick tower = floor_pick;
    tower.cell.y = 1;
    for (int i = 0; i < 20; ++i)
        EXPECT_TRUE(tools.use(with_button(MouseButton::Left, false), tower, down_ray, 8).edits.empty());

    // Dragging fills the cells between, all in the plane.
    stroke = tools.use(with_button(MouseButton::Left, false), tower, towards({9.5f, 1, 5.5f}), 9);
    ASSERT_EQ(stroke.edits.size(), 4u);
    EXPECT_FALSE(stroke.begins);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(stroke.edits[i].center_vox, glm::ivec3(6 + i, 1, 5));
}

TEST(Tools, WaterPoursAtOneSpotAtASaneRate) {
    Tools tools;
    tools.choose(with_key(Key::Digit9));
    std::size_t edits = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto stroke = tools.use(with_button(MouseButton::Left, i == 0, 0.001), floor_pick, down_ray, 0);
        EXPECT_EQ(stroke.begins, i == 0);
        edits += stroke.edits.size();
        for (const Edit& edit : stroke.edits) EXPECT_EQ(edit.center_vox, glm::ivec3(5, 1, 5));
    }
    EXPECT_GE(edits, 19u);
    EXPECT_LE(edits, 21u);
    EXPECT_LE(tools.use(with_button(MouseButton::Left, false, 10), floor_pick, down_ray, 0).edits.size(), 1u);
}

TEST(Tools, RemovingDigsOnAtASaneRate) {
    Tools tools;
    auto stroke = tools.use(with_button(MouseButton::Right, true, 0.001), floor_pick, down_ray, 0);
    ASSERT_EQ(stroke.edits.size(), 1u) << "at once";
    EXPECT_TRUE(stroke.begins);
    EXPECT_TRUE(tools.removing());
    EXPECT_EQ(stroke.edits[0].material, MATERIAL_AIR);
    EXPECT_EQ(stroke.edits[0].center_vox, glm::ivec3(5, 0, 5));
    Pick deeper = floor_pick;
    deeper.cell.y = -1;
    EXPECT_TRUE(tools.use(with_button(MouseButton::Right, false, 0.001), deeper, down_ray, 0).edits.empty());
    stroke = tools.use(with_button(MouseButton::Right, false, 0.5), deeper, down_ray, 0);
    ASSERT_EQ(stroke.edits.size(), 1u);
    EXPECT_FALSE(stroke.begins);
    EXPECT_EQ(stroke.edits[0].center_vox, glm::ivec3(5, -1, 5));
    tools.use(frame(), deeper, down_ray, 0);
    EXPECT_FALSE(tools.removing());
}

TEST(Tools, NothingHappensOffThePictureOrAfterAnEndedStroke) {
    Tools tools;
    Input off = with_button(MouseButton::Left, true);
    off.mouse_on_picture = false;
    EXPECT_TRUE(tools.use(off, floor_pick, down_ray, 0).edits.empty());
    EXPECT_FALSE(tools.aim());
    EXPECT_FALSE(tools.needs_pick(off));
    tools.use(frame(), floor_pick, down_ray, 0);
    EXPECT_EQ(tools.aim(), glm::ivec3(5, 1, 5));
    tools.use(with_button(MouseButton::Left, true), floor_pick, down_ray, 0);
    tools.end_stroke();
    EXPECT_TRUE(tools.use(with_button(MouseButton::Left, false), floor_pick, down_ray, 0).edits.empty());
}

TEST(Tools, OutlineEnclosesTheBrush) {
    for (const BrushShape shape : {BrushShape::Cube, BrushShape::Sphere}) {
        for (const int radius : {0, 3}) {
            const Brush brush{.shape = shape, .radius_vox = radius};
            glm::vec3 low(1e9f);
            glm::vec3 high(-1e9f);
            for (const auto& line : outline_of(brush, {10, 20, 30})) {
                low = glm::min(low, glm::min(line[0], line[1]));
                high = glm::max(high, glm::max(line[0], line[1]));
            }
            const float reach = static_cast<float>(radius) + 0.5f;
            EXPECT_LT(glm::distance(low, glm::vec3(10.5f, 20.5f, 30.5f) - reach), 1e-4f);
            EXPECT_LT(glm::distance(high, glm::vec3(10.5f, 20.5f, 30.5f) + reach), 1e-4f);
        }
    }
    EXPECT_EQ(outline_of({.radius_vox = 0}, {}).size(), 12u);
}

}  // namespace
}  // namespace tarn
