#include "bench/ray_sets.h"

#include <cmath>
#include <numbers>

#include "app/camera.h"
#include "core/error.h"
#include "reference/traversal.h"
#include "shared/hash.h"

namespace tarn {

namespace {

using reference::HitKind;
using reference::RayHit;
using reference::RayStart;

// Uniform in [0,1).
float random_of(std::uint32_t ray, std::uint32_t dimension) {
    return static_cast<float>(hash4(ray, dimension, 0, 1) >> 8) / 16777216.0f;
}

// Malley's method around the face's normal.
glm::vec3 cosine_direction(glm::vec3 normal, int axis, std::uint32_t ray) {
    const float radius = std::sqrt(random_of(ray, 0));
    const float angle = 2 * std::numbers::pi_v<float> * random_of(ray, 1);
    glm::vec3 dir = normal * std::sqrt(std::max(0.0f, 1 - radius * radius));
    dir[(axis + 1) % 3] = radius * std::cos(angle);
    dir[(axis + 2) % 3] = radius * std::sin(angle);
    return glm::normalize(dir);
}

BenchRay ray_from(glm::vec3 origin_vox, glm::ivec3 cell, std::uint32_t medium, glm::vec3 dir) {
    return {glm::vec4(origin_vox, 0), glm::vec4(dir, 0), glm::ivec4(cell, medium)};
}

}  // namespace

RaySet make_primary_rays(const Settings& settings, glm::ivec2 size_px) {
    CHECK(size_px.x % 4 == 0 && size_px.y % 2 == 0);
    const View view(settings, size_px);
    RaySet set{.name = "primary", .from_eye = true, .any_hit = false, .rays = {}};
    for (int y = 0; y < size_px.y; y += 2)
        for (int x = 0; x < size_px.x; x += 4)
            for (int i = 0; i < 8; ++i)
                set.rays.push_back(ray_from(view.eye_vox(), glm::ivec3(0), MATERIAL_AIR,
                                            view.dir_through(glm::vec2(x + i % 4, y + i / 4) + 0.5f)));
    return set;
}

std::vector<RaySet> make_ray_sets(const Cells& cells, const Settings& settings, glm::ivec2 size_px) {
    RaySet primary = make_primary_rays(settings, size_px);
    RaySet diffuse{.name = "diffuse", .from_eye = false, .any_hit = false, .rays = {}};
    RaySet in_water{.name = "in-water", .from_eye = false, .any_hit = false, .rays = {}};
    RaySet shadow{.name = "shadow", .from_eye = false, .any_hit = true, .rays = {}};
    const glm::vec3 to_sun = camera_basis(settings.sun_azimuth_deg, settings.sun_elevation_deg).dir;
    std::uint32_t index = 0;
    for (const BenchRay& ray : primary.rays) {
        const std::uint32_t number = index++;
        const glm::vec3 dir = ray.dir;
        const auto entry = reference::enter_world(cells, ray.origin_vox, dir);
        if (!entry) continue;
        const RayHit hit = reference::trace_ray(cells, entry->start, dir, reference::traversal_t_max);
        if (hit.kind != HitKind::Face || entry->start.medium != MATERIAL_AIR) continue;
        const glm::vec3 point = reference::hit_point(entry->start, dir, hit);
        glm::vec3 normal(0);
        normal[hit.axis] = dir[hit.axis] > 0 ? -1.0f : 1.0f;
        if (hit.beyond == MATERIAL_WATER) {
            const glm::vec3 refracted = glm::refract(dir, normal, 1 / settings.water_ior);
            if (cells.contains(hit.cell) && refracted != glm::vec3(0))
                in_water.rays.push_back(ray_from(point, hit.cell, MATERIAL_WATER, refracted));
            continue;
        }
        if (!cells.contains(hit.previous)) continue;
        diffuse.rays.push_back(
            ray_from(point, hit.previous, MATERIAL_AIR, cosine_direction(normal, hit.axis, number)));
        if (glm::dot(normal, to_sun) > 0)
            shadow.rays.push_back(ray_from(point, hit.previous, MATERIAL_AIR, to_sun));
    }
    std::vector<RaySet> sets;
    for (RaySet* set : {&primary, &diffuse, &in_water, &shadow})
        if (!set->rays.empty()) sets.push_back(std::move(*set));
    return sets;
}

}  // namespace tarn
