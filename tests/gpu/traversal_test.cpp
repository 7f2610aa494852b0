// The shader's walk against the CPU's, bit for bit.
#include <algorithm>
#include <cmath>
#include <span>

#include "brick_rooms.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl_test.h"
#include "reference/traversal.h"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "traversal_cases.h"

namespace tarn {
namespace {

using cases::EyeRay;
using cases::Random;
using cases::WorldKind;
using reference::HitKind;
using reference::RayHit;
using reference::RayStart;

constexpr float far_vox = 1e9f;

// Layouts of tests/kernels/traversal.comp.
struct GpuRay {
    glm::vec4 origin_vox, dir;
    glm::ivec4 cell;
};
struct GpuResult {
    glm::vec4 point;
    glm::ivec4 hit, cell, previous;
    glm::vec4 start_origin;
    glm::ivec4 start_cell;
    bool operator==(const GpuResult&) const = default;
};

// A world on the GPU with what its rays need.
class GpuWorld {
  public:
    explicit GpuWorld(const Cells& cells)
        : cells_({.label = "cells", .format = GL_R8UI, .size = cells.size_vox()}),
          frame_("frame", sizeof(FrameBlock)) {
        cells_.upload<std::uint8_t>(cells.bytes(), GL_RED_INTEGER, GL_UNSIGNED_BYTE);
        const BrickRooms rooms(cells);
        rooms_ = gl::Texture({.label = "brick rooms", .format = GL_RG32UI, .size = rooms.size()});
        rooms_.upload<glm::uvec2>(rooms.words(), GL_RG_INTEGER, GL_UNSIGNED_INT);
        FrameBlock block;
        block.world_size_vox = glm::ivec4(cells.size_vox(), 0);
        frame_.upload(std::span(&block, 1));
    }
    void bind() const {
        cells_.bind_image(IMAGE_CELLS, GL_READ_ONLY);
        rooms_.bind_image(IMAGE_BRICK_ROOMS, GL_READ_ONLY);
        frame_.bind_uniform(BINDING_FRAME);
    }

  private:
    gl::Texture cells_, rooms_;
    gl::Buffer frame_;
};

gl::Program make_program(std::vector<std::pair<std::string, std::string>> defines) {
    return gl::Program({.label = "test traversal",
                        .compute = "tests/kernels/traversal.comp",
                        .defines = std::move(defines)});
}

std::vector<GpuResult> run(const gl::Program& program, const GpuWorld& world, const std::vector<GpuRay>& rays,
                           bool from_eye) {
    gl::Buffer in("rays", rays.size() * sizeof(GpuRay));
    gl::Buffer out("results", rays.size() * sizeof(GpuResult));
    in.upload(rays);
    in.bind_storage(0);
    out.bind_storage(1);
    world.bind();
    program.set("count", static_cast<int>(rays.size()));
    program.set("from_eye", from_eye ? 1 : 0);
    program.dispatch_for({static_cast<int>(rays.size()), 1, 1}, {64, 1, 1});
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<GpuResult> results(rays.size());
    out.download(std::span(results));
    return results;
}

// What the kernel is to write for a ray that starts at `start`.
GpuResult expected(const RayStart& start, float t_entry, glm::vec3 dir, const RayHit& hit) {
    const bool none = hit.kind == HitKind::None;
    return {.point = glm::vec4(none ? start.origin_vox : reference::hit_point(start, dir, hit), hit.t),
            .hit = glm::ivec4(static_cast<int>(hit.kind), hit.axis, hit.beyond, hit.byte_beyond),
            .cell = glm::ivec4(hit.cell, 0),
            .previous = glm::ivec4(hit.previous, 1),
            .start_origin = glm::vec4(start.origin_vox, t_entry),
            .start_cell = glm::ivec4(start.cell, start.medium)};
}

std::string text(const GpuResult& r) {
    return fmt::format(
        "kind {} axis {} beyond {} byte {} t {:a} cell {} {} {} previous {} {} {} found {} point {:a} {:a} "
        "{:a} "
        "start {:a} {:a} {:a} in {} {} {} medium {} entry {:a}",
        r.hit.x, r.hit.y, r.hit.z, r.hit.w, r.point.w, r.cell.x, r.cell.y, r.cell.z, r.previous.x,
        r.previous.y, r.previous.z, r.previous.w, r.point.x, r.point.y, r.point.z, r.start_origin.x,
        r.start_origin.y, r.start_origin.z, r.start_cell.x, r.start_cell.y, r.start_cell.z, r.start_cell.w,
        r.start_origin.w);
}

// Equal up to the number of iterations and the sign of zeros.
void expect_equal(const std::vector<GpuResult>& found, const std::vector<GpuResult>& wanted,
                  const std::vector<GpuRay>& rays, const std::string& where) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        GpuResult result = found[i];
        result.cell.w = 0;
        if (result == wanted[i]) continue;
        if (different++ != 0) continue;
        const GpuRay& ray = rays[i];
        ADD_FAILURE() << fmt::format("{}: ray {} from {:a} {:a} {:a} along {:a} {:a} {:a}\nGPU {}\nCPU {}",
                                     where, i, ray.origin_vox.x, ray.origin_vox.y, ray.origin_vox.z,
                                     ray.dir.x, ray.dir.y, ray.dir.z, text(result), text(wanted[i]));
    }
    EXPECT_EQ(different, 0u) << where << " of " << wanted.size();
}

struct Case {
    const char* name;
    WorldKind kind;
    glm::ivec3 size;
};
constexpr int rays_per_case = 65536;

class TraversalGpu : public GlTest {
  protected:
    // Rays from the eye, then the rays that go on from what they hit, in every world.
    static void compare(const gl::Program& program, std::uint32_t seed) {
        const std::vector<Case> worlds = {
            {"sparse 64^3", WorldKind::Sparse, {64, 64, 64}},
            {"dense 61x37x45", WorldKind::Dense, {61, 37, 45}},
            {"terrain 64^3", WorldKind::Terrain, {64, 64, 64}},
            {"amounts 61x37x45", WorldKind::Amounts, {61, 37, 45}},
            {"deep 64^3", WorldKind::Deep, {64, 64, 64}},
            {"air 61x37x45", WorldKind::Air, {61, 37, 45}},
            {"dense 7x13x5", WorldKind::Dense, {7, 13, 5}},
            {"one voxel", WorldKind::Deep, {1, 1, 1}},
        };
        for (const Case& world : worlds) {
            const Cells cells = cases::make_world(world.kind, world.size, seed);
            const GpuWorld gpu(cells);
            Random random(seed + 1);
            std::vector<GpuRay> eye, onward;
            std::vector<GpuResult> eye_wanted, onward_wanted;
            while (eye.size() + onward.size() < rays_per_case) {
                const EyeRay ray = eye.size() % 4 == 0 ? cases::random_ray(world.size, random)
                                                       : cases::hard_ray(world.size, random);
                eye.push_back(
                    {glm::vec4(ray.origin_vox, ray.t_max_vox), glm::vec4(ray.dir, 0), glm::ivec4(0)});
                eye_wanted.emplace_back();
                const auto entry = reference::enter_world(cells, ray.origin_vox, ray.dir);
                if (!entry) continue;
                const RayHit hit = reference::trace_ray(cells, entry->start, ray.dir, ray.t_max_vox);
                eye_wanted.back() = expected(entry->start, entry->t_entry, ray.dir, hit);
                if (hit.kind == HitKind::None) continue;
                glm::vec3 dir;
                const RayStart start = cases::after_hit(entry->start, ray.dir, hit, random, dir);
                onward.push_back({glm::vec4(start.origin_vox, far_vox), glm::vec4(dir, 0),
                                  glm::ivec4(start.cell, start.medium)});
                onward_wanted.push_back(
                    expected(start, 0, dir, reference::trace_ray(cells, start, dir, far_vox)));
            }
            expect_equal(run(program, gpu, eye, true), eye_wanted, eye, fmt::format("{}, eye", world.name));
            if (onward.empty()) continue;
            expect_equal(run(program, gpu, onward, false), onward_wanted, onward,
                         fmt::format("{}, onward", world.name));
        }
    }
};

TEST_F(TraversalGpu, EqualsTheReferenceVoxelByVoxel) {
    compare(make_program({}), 1);
}

TEST_F(TraversalGpu, EqualsTheReferenceWithSkips) {
    compare(make_program({{"TRAVERSAL_SKIP", "1"}}), 2);
}

TEST_F(TraversalGpu, SkipsSaveIterationsAndChangeNothing) {
    const gl::Program plain = make_program({});
    const gl::Program skipping = make_program({{"TRAVERSAL_SKIP", "1"}});
    for (const auto& [name, kind, size] : {Case{"air 128x96x128", WorldKind::Air, {128, 96, 128}},
                                           Case{"air 1024x17x1023", WorldKind::Air, {1024, 17, 1023}},
                                           Case{"deep 128x96x128", WorldKind::Deep, {128, 96, 128}}}) {
        const Cells cells = cases::make_world(kind, size, 5);
        const GpuWorld world(cells);
        Random random(6);
        std::vector<GpuRay> rays;
        for (int i = 0; i < 65536; ++i) {
            const EyeRay ray = cases::random_ray(cells.size_vox(), random);
            rays.push_back({glm::vec4(ray.origin_vox, far_vox), glm::vec4(ray.dir, 0), glm::ivec4(0)});
        }
        auto slow = run(plain, world, rays, true);
        auto fast = run(skipping, world, rays, true);
        std::int64_t slow_steps = 0;
        std::int64_t fast_steps = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            slow_steps += slow[i].cell.w;
            fast_steps += fast[i].cell.w;
            slow[i].cell.w = 0;
        }
        expect_equal(fast, slow, rays, fmt::format("{}, skip against none", name));
        EXPECT_LT(fast_steps * (kind == WorldKind::Air ? 8 : 1), slow_steps) << name;
    }
}

TEST_F(TraversalGpu, ThroughWaterSeesTheWorldWithoutIt) {
    const Cells cells = cases::make_world(WorldKind::Terrain, {61, 37, 45}, 7);
    Cells dry = cells;
    for (std::uint8_t& byte : dry.bytes())
        if (is_water(byte)) byte = MATERIAL_AIR;
    const GpuWorld wet_world(cells);
    const GpuWorld dry_world(dry);
    Random random(8);
    std::vector<GpuRay> rays;
    for (int i = 0; i < 65536; ++i) {
        const EyeRay ray = cases::hard_ray(cells.size_vox(), random);
        rays.push_back({glm::vec4(ray.origin_vox, ray.t_max_vox), glm::vec4(ray.dir, 0), glm::ivec4(0)});
    }
    auto wanted = run(make_program({}), dry_world, rays, true);
    for (GpuResult& result : wanted) result.cell.w = 0;
    const auto found =
        run(make_program({{"TRAVERSAL_THROUGH_WATER", "1"}, {"TRAVERSAL_SKIP", "1"}}), wet_world, rays, true);
    expect_equal(found, wanted, rays, "through water");
}

std::vector<GpuResult> trace(const Cells& cells, const std::vector<GpuRay>& rays) {
    return run(make_program({{"TRAVERSAL_SKIP", "1"}}), GpuWorld(cells), rays, true);
}

TEST_F(TraversalGpu, Fault2_RaysAlongAnAxisAndFromBoundariesHit) {
    Cells cells({33, 33, 33});
    cells.at({16, 16, 16}) = MATERIAL_STONE;
    std::vector<GpuRay> rays;
    for (int axis = 0; axis < 3; ++axis) {
        for (int step = -4; step <= 36; ++step) {
            for (const float within : {0.0f, 0.25f}) {  // 0: along an edge, which belongs to the upper voxel
                glm::vec3 origin(16 + within);
                origin[axis] = static_cast<float>(step);
                glm::vec3 dir(-0.0f);
                dir[axis] = step <= 16 ? 1.0f : -1.0f;
                rays.push_back({glm::vec4(origin, far_vox), glm::vec4(dir, 0), glm::ivec4(0)});
            }
        }
    }
    for (const GpuResult& result : trace(cells, rays)) {
        const bool starts_inside = result.start_cell.w == MATERIAL_STONE;
        EXPECT_EQ(result.hit.x, 1) << text(result);
        EXPECT_EQ(result.hit.z, starts_inside ? MATERIAL_AIR : MATERIAL_STONE) << text(result);
    }
}

TEST_F(TraversalGpu, Fault7_ARayInWaterThatRunsOutReturnsNoHit) {
    Cells cells({24, 24, 24});
    for (std::uint8_t& byte : cells.bytes()) byte = MATERIAL_WATER_FULL;
    Random random(9);
    std::vector<GpuRay> rays;
    for (int i = 0; i < 4096; ++i) {
        const float limit = i % 2 == 0 ? 7.5f : far_vox;
        rays.push_back({glm::vec4(random.point(glm::vec3(8), glm::vec3(16)), limit),
                        glm::vec4(random.direction(), 0), glm::ivec4(0)});
    }
    const auto results = trace(cells, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(results[i].hit.x, i % 2 == 0 ? 0 : 1) << text(results[i]);
        EXPECT_GE(results[i].point.w, 7.5f) << text(results[i]);
        EXPECT_EQ(results[i].hit.z, MATERIAL_AIR) << text(results[i]);
    }
}

}  // namespace
}  // namespace tarn
