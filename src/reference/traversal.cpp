#include "reference/traversal.h"

#include <algorithm>
#include <cmath>

namespace tarn::reference {

bool is_partly_filled(std::uint32_t byte) {
    return is_water(byte) && byte != MATERIAL_WATER_FULL;
}

float surface_height(glm::ivec3 cell, std::uint32_t byte) {
    return static_cast<float>(cell.y) + static_cast<float>(quanta_of(byte)) * 0.0625f;
}

namespace {

// One axis of a ray: when it passes the plane at `plane`.
struct Axis {
    float origin, inv_dir;
    bool still, forward;

    Axis(float o, float d) {
        still = std::abs(d) < traversal_still;
        forward = d >= traversal_still;
        origin = still ? -traversal_never : o;
        inv_dir = still ? 1.0f : 1.0f / d;
    }
    float time_of(float plane) const { return (plane - origin) * inv_dir; }
    int stride() const { return forward ? 1 : -1; }
};

}  // namespace

RayHit trace_ray(const Cells& cells, const RayStart& start, glm::vec3 dir, float t_max_vox) {
    const Axis axes[3] = {Axis(start.origin_vox.x, dir.x), Axis(start.origin_vox.y, dir.y),
                          Axis(start.origin_vox.z, dir.z)};
    const Axis& up = axes[1];
    const float limit = std::min(t_max_vox, traversal_t_max);
    const RayHit none{.t = t_max_vox, .previous = start.cell, .cell = start.cell};
    const glm::ivec3 size = cells.size_vox();
    const int bound = size.x + size.y + size.z + 4;

    glm::ivec3 cell = start.cell;
    for (int i = 0; i < bound; ++i) {
        // The face through which the ray leaves this cell; ties go x < y < z.
        int axis = 0;
        float t_exit = 0;
        for (int k = 0; k < 3; ++k) {
            const float t = axes[k].time_of(static_cast<float>(cell[k] + (axes[k].forward ? 1 : 0)));
            if (k == 0 || t < t_exit) {
                axis = k;
                t_exit = t;
            }
        }

        // The surface within it, if the ray heads for it.
        const std::uint32_t here = cells.get(cell, MATERIAL_AIR);
        if (is_partly_filled(here) && !up.still && up.forward == (start.medium == MATERIAL_WATER)) {
            const float t_surface = up.time_of(surface_height(cell, here));
            if (t_surface <= t_exit) {
                if (t_surface > limit) return none;
                return {.kind = HitKind::Surface,
                        .t = t_surface > 0 ? t_surface : 0.0f,
                        .previous = cell,
                        .cell = cell,
                        .axis = 1,
                        .beyond = start.medium == MATERIAL_WATER ? MATERIAL_AIR : MATERIAL_WATER,
                        .byte_beyond = here};
            }
        }
        if (!(t_exit <= limit)) return none;

        const glm::ivec3 previous = cell;
        cell[axis] += axes[axis].stride();
        const std::uint32_t next = cells.get(cell, MATERIAL_AIR);
        std::uint32_t beyond = material_of(next);
        if (is_partly_filled(next)) {
            const float height = surface_height(cell, next);
            const float t_surface = up.time_of(height);
            const bool below = up.still     ? start.origin_vox.y < height
                               : up.forward ? t_exit < t_surface
                                            : t_exit >= t_surface;
            beyond = below ? MATERIAL_WATER : MATERIAL_AIR;
        }
        if (beyond != start.medium) {
            return {.kind = HitKind::Face,
                    .t = t_exit > 0 ? t_exit : 0.0f,
                    .previous = previous,
                    .cell = cell,
                    .axis = axis,
                    .beyond = beyond,
                    .byte_beyond = next};
        }
        if (!cells.contains(cell)) return none;
    }
    return none;
}

std::optional<Entry> enter_world(const Cells& cells, glm::vec3 origin, glm::vec3 dir) {
    const glm::vec3 size(cells.size_vox());
    float t_near = -traversal_never;
    float t_far = traversal_never;
    int entry_axis = -1;
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
        const bool back = dir[k] <= -traversal_still;
        const bool within = (origin[k] > 0 || (origin[k] == 0 && !back)) &&
                            (origin[k] < size[k] || (origin[k] == size[k] && back));
        inside = inside && within;
        const Axis axis(origin[k], dir[k]);
        if (axis.still) {
            if (!within) return std::nullopt;
            continue;
        }
        const float t0 = axis.time_of(axis.forward ? 0.0f : size[k]);
        const float t1 = axis.time_of(axis.forward ? size[k] : 0.0f);
        if (t0 >= t_near) {
            t_near = t0;
            entry_axis = k;
        }
        if (t1 < t_far) t_far = t1;
    }

    Entry entry{.start = {.origin_vox = origin}};
    RayStart& start = entry.start;
    if (!inside) {
        if (!(t_near >= 0 && t_near <= t_far && t_near <= traversal_t_max)) return std::nullopt;
        entry.t_entry = t_near;
        start.origin_vox = glm::clamp(origin + t_near * dir, glm::vec3(0), size);
    }
    for (int k = 0; k < 3; ++k) {
        const float coordinate = start.origin_vox[k];
        const float lower = dir[k] <= -traversal_still ? std::ceil(coordinate) - 1 : std::floor(coordinate);
        start.cell[k] = std::clamp(static_cast<int>(lower), 0, cells.size_vox()[k] - 1);
    }
    if (!inside) {
        const bool forward = dir[entry_axis] >= traversal_still;
        start.origin_vox[entry_axis] = forward ? 0.0f : size[entry_axis];
        start.cell[entry_axis] = forward ? -1 : cells.size_vox()[entry_axis];
        return entry;
    }
    const std::uint32_t byte = cells.at(start.cell);
    start.medium = material_of(byte);
    if (is_partly_filled(byte) && !(origin.y < surface_height(start.cell, byte))) start.medium = MATERIAL_AIR;
    return entry;
}

glm::vec3 hit_point(const RayStart& start, glm::vec3 dir, const RayHit& hit) {
    glm::vec3 point = start.origin_vox + hit.t * dir;
    point = glm::clamp(point, glm::vec3(hit.previous), glm::vec3(hit.previous + 1));
    if (hit.kind == HitKind::Surface) {
        point.y = surface_height(hit.cell, hit.byte_beyond);
    } else {
        point[hit.axis] = static_cast<float>(std::max(hit.previous[hit.axis], hit.cell[hit.axis]));
    }
    return point;
}

}  // namespace tarn::reference
