#include "reference/pressure_field.h"

#include <algorithm>
#include <cstdlib>

#include "reference/water_lines.h"
#include "shared/water.h"

namespace tarn::reference {

namespace {

int content_at(const Cells& cells, glm::ivec3 cell) {
    return content_of(cells.get(cell, MATERIAL_WALL));
}

// Above the world is sky.
int content_above(const Cells& cells, glm::ivec3 cell) {
    return cell.y + 1 == cells.size_vox().y ? 0 : content_at(cells, cell + glm::ivec3(0, 1, 0));
}

bool under_ceiling(const Cells& cells, glm::ivec3 cell) {
    return !is_open(content_above(cells, cell));
}

// Whether head passes through the cell.
bool conducts(const Cells& cells, glm::ivec3 cell, int film_threshold) {
    const int content = content_at(cells, cell);
    if (!is_open(content) || content == 0) return false;
    return 2 * content >= static_cast<int>(QUANTA_PER_VOXEL) ||
           (content >= film_threshold && under_ceiling(cells, cell));
}

// A free surface feeds head if it stands and is not the edge of a bump.
bool feeds(const Cells& cells, glm::ivec3 cell, int film_threshold) {
    const int half = static_cast<int>(QUANTA_PER_VOXEL) / 2;
    const int above = content_above(cells, cell);
    const int below = content_at(cells, cell - glm::ivec3(0, 1, 0));
    if (!is_open(above) || above >= half || (is_open(below) && below < half)) return false;
    for (const glm::ivec3 side :
         {glm::ivec3(1, 0, 0), glm::ivec3(-1, 0, 0), glm::ivec3(0, 0, 1), glm::ivec3(0, 0, -1)}) {
        const int beside = content_at(cells, cell + side);
        if (is_open(beside) && beside < film_threshold) return false;
    }
    return true;
}

}  // namespace

PressureField::PressureField(glm::ivec3 size_vox)
    : size_(size_vox),
      acting_(std::size_t{1} * size_vox.x * size_vox.y * size_vox.z),
      building_(acting_.size()) {}

void PressureField::sweep(const Cells& cells, Activity& activity, int film_threshold) {
    if (sweeps_ > 0) quiet_sweeps_ = found_ ? 0 : quiet_sweeps_ + 1;
    if (quiet_sweeps_ >= 3 || sweeps_ >= HEAD_SWEEPS_MAX) publish(activity);
    // Up and down first: that is where the surfaces are.
    constexpr int axes[] = {1, 0, 2};
    found_ = sweep_lines(cells, axes[sweeps_ % 3], sweeps_ == 0, film_threshold);
    ++sweeps_;
}

bool PressureField::sweep_lines(const Cells& cells, int axis, bool seed, int film_threshold) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    bool found = false;
    for (int j = 0; j < size_[v]; ++j)
        for (int i = 0; i < size_[u]; ++i)
            for (const bool forward : {true, false}) {
                std::uint32_t carried = 0;
                for (int k = 0; k < size_[axis]; ++k) {
                    glm::ivec3 cell;
                    cell[axis] = forward ? k : size_[axis] - 1 - k;
                    cell[u] = i;
                    cell[v] = j;
                    if (!conducts(cells, cell, film_threshold)) {
                        carried = 0;
                        continue;
                    }
                    std::uint32_t& head = building_[index(cell)];
                    const std::uint32_t before = head;
                    if ((carried & head_reach_mask) != 0) {
                        carried -= head_step;
                        if (under_ceiling(cells, cell)) carried &= ~head_open;
                        head = std::max(head, carried);
                    }
                    if (seed && forward && feeds(cells, cell, film_threshold)) {
                        const int height =
                            cell.y * head_per_voxel + content_at(cells, cell) * head_per_voxel / 16;
                        head = std::max(head, static_cast<std::uint32_t>(height) << head_height_shift |
                                                  head_reach_mask | head_open);
                    }
                    carried = head;
                    found = found || head != before;
                }
            }
    return found;
}

void PressureField::publish(Activity& activity) {
    sweeps_ = 0;
    quiet_sweeps_ = 0;
    std::size_t i = 0;
    for (int z = 0; z < size_.z; ++z)
        for (int y = 0; y < size_.y; ++y)
            for (int x = 0; x < size_.x; ++x, ++i) {
                const int before = is_confined(acting_[i]) ? height_of(acting_[i]) : 0;
                const int after = is_confined(building_[i]) ? height_of(building_[i]) : 0;
                if (std::abs(after - before) > 1) activity.changed({x, y, z});
                acting_[i] = building_[i];
                building_[i] = 0;
            }
}

}  // namespace tarn::reference
