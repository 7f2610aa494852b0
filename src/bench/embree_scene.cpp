#include "bench/embree_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "app/stopwatch.h"
#include "core/error.h"

#ifdef TARN_EMBREE
#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace tarn {

namespace {

constexpr std::size_t packet = 8;

// Embree knows no start cell: rays that go on from a face must not meet that face again.
constexpr float near_of_going_on_vox = 1e-3f;

}  // namespace

EmbreeRays::EmbreeRays(const RaySet& set)
    : any_hit(set.any_hit),
      coherent(set.from_eye || set.any_hit),
      near_vox(set.from_eye ? 0 : near_of_going_on_vox),
      count(set.rays.size()) {
    const std::size_t padded = (count + packet - 1) / packet * packet;
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < padded; ++i) {
            const BenchRay& ray = set.rays[std::min(i, count - 1)];
            origin[axis].push_back(ray.origin_vox[axis]);
            dir[axis].push_back(ray.dir[axis]);
        }
    }
}

#ifndef TARN_EMBREE

struct EmbreeScene::Parts {};

std::string embree_version() {
    return "";
}
EmbreeScene::EmbreeScene(const Cells& /*cells*/, int /*threads*/) {
    fail("this program was built without Embree; install libembree-dev and configure anew");
}
EmbreeScene::~EmbreeScene() = default;
std::size_t EmbreeScene::quads() const {
    return 0;
}
double EmbreeScene::mesh_ms() const {
    return 0;
}
double EmbreeScene::build_ms() const {
    return 0;
}
double EmbreeScene::trace(const EmbreeRays& /*rays*/, bool /*packets*/, std::vector<float>& /*out*/) const {
    return 0;
}

#else

namespace {

constexpr std::size_t rays_per_turn = 4096;  // that a thread takes

enum class Medium { Air, Water, Solid };
Medium medium_of(std::uint8_t byte) {
    if (byte == MATERIAL_AIR) return Medium::Air;
    return is_water(byte) ? Medium::Water : Medium::Solid;
}

// Corners of unit squares, four a face.
std::vector<glm::vec3> exposed_faces(const Cells& cells) {
    std::vector<glm::vec3> corners;
    const glm::ivec3 size = cells.size_vox();
    const auto add = [&](glm::ivec3 at, int axis) {
        glm::vec3 u(0);
        glm::vec3 v(0);
        u[(axis + 1) % 3] = 1;
        v[(axis + 2) % 3] = 1;
        const glm::vec3 corner(at);
        corners.insert(corners.end(), {corner, corner + u, corner + u + v, corner + v});
    };
    for (int z = 0; z <= size.z; ++z)
        for (int y = 0; y <= size.y; ++y)
            for (int x = 0; x <= size.x; ++x) {
                const glm::ivec3 at(x, y, z);
                const Medium here = medium_of(cells.get(at, MATERIAL_AIR));
                for (int axis = 0; axis < 3; ++axis) {
                    glm::ivec3 below = at;
                    --below[axis];
                    if (medium_of(cells.get(below, MATERIAL_AIR)) != here) add(at, axis);
                }
            }
    return corners;
}

// On every thread that calls Embree, as its manual asks.
void flush_denormals() {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

constexpr float never = std::numeric_limits<float>::infinity();

void fill(RTCRay8& ray, const EmbreeRays& rays, std::size_t first) {
    std::copy_n(rays.origin[0].data() + first, packet, ray.org_x);
    std::copy_n(rays.origin[1].data() + first, packet, ray.org_y);
    std::copy_n(rays.origin[2].data() + first, packet, ray.org_z);
    std::copy_n(rays.dir[0].data() + first, packet, ray.dir_x);
    std::copy_n(rays.dir[1].data() + first, packet, ray.dir_y);
    std::copy_n(rays.dir[2].data() + first, packet, ray.dir_z);
    std::fill_n(ray.tnear, packet, rays.near_vox);
    std::fill_n(ray.tfar, packet, never);
    std::fill_n(ray.time, packet, 0.0f);
    std::fill_n(ray.mask, packet, ~0u);
    std::fill_n(ray.flags, packet, 0u);
}

void fill(RTCRay& ray, const EmbreeRays& rays, std::size_t i) {
    ray = {.org_x = rays.origin[0][i],
           .org_y = rays.origin[1][i],
           .org_z = rays.origin[2][i],
           .tnear = rays.near_vox,
           .dir_x = rays.dir[0][i],
           .dir_y = rays.dir[1][i],
           .dir_z = rays.dir[2][i],
           .time = 0,
           .tfar = never,
           .mask = ~0u,
           .id = 0,
           .flags = 0};
}

// Embree sets tfar to -inf where rtcOccluded meets something.
float distance_of(float t_far, bool any_hit) {
    if (any_hit) return t_far < 0 ? 0.0f : -1.0f;
    return t_far < never ? t_far : -1.0f;
}

void trace_packets(RTCScene scene, const EmbreeRays& rays, std::size_t first, std::size_t last, float* out) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (rays.coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(32) const int valid[packet] = {-1, -1, -1, -1, -1, -1, -1, -1};
    RTCRayHit8 hit;
    for (std::size_t i = first; i < last; i += packet) {
        fill(hit.ray, rays, i);
        if (rays.any_hit) {
            rtcOccluded8(valid, scene, &context, &hit.ray);
        } else {
            std::fill_n(hit.hit.geomID, packet, RTC_INVALID_GEOMETRY_ID);
            std::fill_n(hit.hit.instID[0], packet, RTC_INVALID_GEOMETRY_ID);
            rtcIntersect8(valid, scene, &context, &hit);
        }
        for (std::size_t lane = 0; lane < packet; ++lane)
            out[i + lane] = distance_of(hit.ray.tfar[lane], rays.any_hit);
    }
}

void trace_single(RTCScene scene, const EmbreeRays& rays, std::size_t first, std::size_t last, float* out) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (rays.coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit hit;
    for (std::size_t i = first; i < last; ++i) {
        fill(hit.ray, rays, i);
        if (rays.any_hit) {
            rtcOccluded1(scene, &context, &hit.ray);
        } else {
            hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &hit);
        }
        out[i] = distance_of(hit.ray.tfar, rays.any_hit);
    }
}

}  // namespace

std::string embree_version() {
    return "Embree " RTC_VERSION_STRING;
}

struct EmbreeScene::Parts {
    int threads;
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::size_t quads = 0;
    double mesh_ms = 0, build_ms = 0;

    explicit Parts(int threads_) : threads(threads_) {
        device = rtcNewDevice(fmt::format("threads={}", threads).c_str());
        if (device == nullptr)
            fail("Embree makes no device: error {}", static_cast<int>(rtcGetDeviceError(nullptr)));
    }
    ~Parts() {
        if (scene != nullptr) rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
};

EmbreeScene::EmbreeScene(const Cells& cells, int threads) : parts_(std::make_unique<Parts>(threads)) {
    Parts& p = *parts_;
    const Stopwatch mesh_watch;
    const std::vector<glm::vec3> corners = exposed_faces(cells);
    p.mesh_ms = mesh_watch.ms();
    p.quads = corners.size() / 4;
    if (corners.empty()) fail("Embree: the world has no face");

    const RTCGeometry geometry = rtcNewGeometry(p.device, RTC_GEOMETRY_TYPE_QUAD);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corners.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(std::uint32_t), p.quads));
    if (vertices == nullptr || indices == nullptr) fail("Embree: no memory for {} faces", p.quads);
    std::copy(corners.begin(), corners.end(), vertices);
    for (std::size_t i = 0; i < corners.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);

    const Stopwatch build_watch;
    rtcCommitGeometry(geometry);
    p.scene = rtcNewScene(p.device);
    rtcAttachGeometry(p.scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(p.scene);
    p.build_ms = build_watch.ms();
    if (const RTCError error = rtcGetDeviceError(p.device); error != RTC_ERROR_NONE)
        fail("Embree: error {} while building over {} faces", static_cast<int>(error), p.quads);
}

EmbreeScene::~EmbreeScene() = default;

std::size_t EmbreeScene::quads() const {
    return parts_->quads;
}
double EmbreeScene::mesh_ms() const {
    return parts_->mesh_ms;
}
double EmbreeScene::build_ms() const {
    return parts_->build_ms;
}

double EmbreeScene::trace(const EmbreeRays& rays, bool packets, std::vector<float>& distance_vox) const {
    distance_vox.resize(rays.origin[0].size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        flush_denormals();
        for (std::size_t first = next.fetch_add(rays_per_turn); first < distance_vox.size();
             first = next.fetch_add(rays_per_turn)) {
            const std::size_t last = std::min(first + rays_per_turn, distance_vox.size());
            if (packets)
                trace_packets(parts_->scene, rays, first, last, distance_vox.data());
            else
                trace_single(parts_->scene, rays, first, last, distance_vox.data());
        }
    };
    const Stopwatch watch;
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(parts_->threads));
    for (int i = 0; i < parts_->threads; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    const double ms = watch.ms();
    distance_vox.resize(rays.count);
    return ms;
}

#endif

}  // namespace tarn
