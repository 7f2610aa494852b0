#include "app/tools.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tarn {

namespace {

// A held button pours this often and digs this often.
constexpr double pour_interval_s = 0.05;
constexpr double dig_interval_s = 0.15;
// A fast drag is filled in by at most so many edits a frame.
constexpr int drag_edits_max = 16;
constexpr int circle_segments = 48;

bool pours(std::uint8_t material) {
    return material == MATERIAL_WATER || material == MATERIAL_SAND;
}

}  // namespace

std::optional<glm::ivec3> target_cell(const Pick& pick, bool placing, glm::vec3 eye_vox) {
    if (!pick.hit || glm::distance(glm::vec3(pick.cell) + 0.5f, eye_vox) > reach_vox) return std::nullopt;
    if (!placing) return pick.cell;
    if (pick.normal == glm::ivec3(0)) return std::nullopt;
    return pick.cell + pick.normal;
}

std::vector<std::array<glm::vec3, 2>> outline_of(const Brush& brush, glm::ivec3 center_vox) {
    std::vector<std::array<glm::vec3, 2>> lines;
    const glm::vec3 center = glm::vec3(center_vox) + 0.5f;
    const float reach = static_cast<float>(brush.radius_vox) + 0.5f;
    if (brush.shape == BrushShape::Cube || brush.radius_vox == 0) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int corner = 0; corner < 4; ++corner) {
                glm::vec3 from(-reach);
                from[(axis + 1) % 3] = (corner & 1) != 0 ? reach : -reach;
                from[(axis + 2) % 3] = (corner & 2) != 0 ? reach : -reach;
                glm::vec3 to = from;
                to[axis] = reach;
                lines.push_back({center + from, center + to});
            }
        }
        return lines;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const auto point = [&](int i) {
            const float angle =
                2 * std::numbers::pi_v<float> * static_cast<float>(i % circle_segments) / circle_segments;
            glm::vec3 offset(0);
            offset[(axis + 1) % 3] = reach * std::cos(angle);
            offset[(axis + 2) % 3] = reach * std::sin(angle);
            return center + offset;
        };
        for (int i = 0; i < circle_segments; ++i) lines.push_back({point(i), point(i + 1)});
    }
    return lines;
}

void Tools::choose(const Input& input) {
    for (std::size_t i = 0; i < palette.size(); ++i) {
        const auto key = static_cast<Key>(static_cast<std::size_t>(Key::Digit1) + i);
        if (input.was_pressed(key)) brush.material = palette[i];
    }
    if (input.was_pressed(Key::Brush))
        brush.shape = brush.shape == BrushShape::Sphere ? BrushShape::Cube : BrushShape::Sphere;
    if (input.was_pressed(Key::Overwrite)) brush.overwrite = !brush.overwrite;
    wheel_rest_ += std::clamp(input.wheel, -64.f, 64.f);
    const float steps = std::trunc(wheel_rest_);
    wheel_rest_ -= steps;
    brush.radius_vox = std::clamp(brush.radius_vox + static_cast<int>(steps), 0, brush_radius_max_vox);
}

void Tools::take_material(const Pick& pick) {
    const auto id = static_cast<std::uint8_t>(material_of(pick.byte));
    if (pick.hit && std::find(palette.begin(), palette.end(), id) != palette.end()) brush.material = id;
}

bool Tools::needs_pick(const Input& input) const {
    const bool keeps_plane = mode_ == Mode::Place && plane_ && input.is_down(MouseButton::Left) &&
                             !input.was_pressed(MouseButton::Left);
    return input.mouse_on_picture && !keeps_plane;
}

void Tools::start_or_end(const Input& input) {
    const auto start = [&](Mode mode) {
        mode_ = mode;
        plane_.reset();
        last_.reset();
        since_edit_s_ = dig_interval_s;
    };
    if (input.was_pressed(MouseButton::Left))
        start(Mode::Place);
    else if (input.was_pressed(MouseButton::Right))
        start(Mode::Remove);
    else if ((mode_ == Mode::Place && !input.is_down(MouseButton::Left)) ||
             (mode_ == Mode::Remove && !input.is_down(MouseButton::Right)))
        mode_ = Mode::Idle;
}

std::optional<glm::ivec3> Tools::aim_in_plane(const Ray& ray) const {
    const float along = ray.dir[plane_->axis];
    const float t = (plane_->at_vox - ray.origin[plane_->axis]) / along;
    if (along == 0 || !(t > 0 && t < reach_vox)) return std::nullopt;
    glm::ivec3 cell(glm::floor(ray.origin + t * ray.dir));
    cell[plane_->axis] = plane_->cell;
    return cell;
}

void Tools::place_up_to(glm::ivec3 cell, Stroke& stroke, Edit edit) {
    const glm::ivec3 from = last_.value_or(cell);
    const glm::ivec3 path = cell - from;
    const int length = std::max({std::abs(path.x), std::abs(path.y), std::abs(path.z)});
    const int spacing = std::max(1, brush.radius_vox);
    const int steps = std::clamp((length + spacing - 1) / spacing, 1, drag_edits_max);
    for (int i = 1; i <= steps; ++i) {
        const glm::vec3 offset = glm::vec3(path) * (static_cast<float>(i) / static_cast<float>(steps));
        edit.center_vox = from + glm::ivec3(glm::round(offset));
        stroke.edits.push_back(edit);
    }
    last_ = cell;
    since_edit_s_ = 0;
}

Tools::Stroke Tools::use(const Input& input, const Pick& pick, const Ray& ray, std::uint64_t tick) {
    Stroke stroke;
    start_or_end(input);
    since_edit_s_ += std::max(0.0, input.dt_s);
    if (!input.mouse_on_picture) {
        aim_.reset();
        return stroke;
    }
    Edit edit{.tick = tick,
              .shape = brush.shape,
              .center_vox = {},
              .radius_vox = brush.radius_vox,
              .material = brush.material,
              .overwrite = brush.overwrite};
    if (mode_ == Mode::Remove) {
        aim_ = target_cell(pick, false, ray.origin);
        edit.material = MATERIAL_AIR;
        if (aim_ && since_edit_s_ >= dig_interval_s) {
            stroke.begins = !last_.has_value();
            edit.center_vox = *aim_;
            stroke.edits.push_back(edit);
            last_ = aim_;
            since_edit_s_ = 0;
        }
        return stroke;
    }
    if (plane_ && mode_ == Mode::Place)
        aim_ = aim_in_plane(ray);
    else
        aim_ = target_cell(pick, true, ray.origin);
    if (mode_ == Mode::Idle || !aim_) return stroke;
    if (!plane_) {
        const int axis = pick.normal.x != 0 ? 0 : pick.normal.y != 0 ? 1 : 2;
        const int face = pick.normal[axis] > 0 ? (*aim_)[axis] : (*aim_)[axis] + 1;
        plane_ = {axis, static_cast<float>(face), (*aim_)[axis]};
    }
    const bool moved = !last_ || *last_ != *aim_;
    if (moved || (pours(brush.material) && since_edit_s_ >= pour_interval_s)) {
        stroke.begins = !last_.has_value();
        place_up_to(*aim_, stroke, edit);
    }
    return stroke;
}

}  // namespace tarn
