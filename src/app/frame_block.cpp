#include "app/frame_block.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/camera.h"
#include "app/clear_sky.h"
#include "shared/trace.h"

namespace tarn {

namespace {

void set_sun(FrameBlock& block, const Settings& s) {
    const bool clear_sky = s.sky_model == SkyModel::Preetham;
    const glm::dvec3 irradiance = clear_sky ? clear_sky_sunlight(s) : glm::dvec3(s.sun_irradiance);
    const double radius = glm::radians(static_cast<double>(s.sun_angular_radius_deg));
    const bool exists = std::max({irradiance.x, irradiance.y, irradiance.z}) > 0;
    // 1 - cos r = 2 sin^2(r / 2): no cancellation for small discs.
    const double versine = 2 * std::pow(std::sin(radius / 2), 2);
    block.sun_dir = glm::vec4(camera_basis(s.sun_azimuth_deg, s.sun_elevation_deg).dir, versine);
    const double solid_angle = 2 * std::numbers::pi * versine;
    const double projected = std::numbers::pi * std::pow(std::sin(radius), 2);
    const bool disc = exists && radius > 0 && projected > 0;
    block.sun_irradiance = glm::vec4(irradiance, disc ? solid_angle : 0.0);
    block.sun_radiance =
        glm::vec4(disc ? glm::vec3(irradiance / projected) : glm::vec3(0), exists ? 1.0f : 0.0f);
}

// Of the shown pixel for which a traced one stands in this frame: all places in turn, neighbours in time far
// apart.
glm::vec2 place_in_cell(const FrameInputs& in) {
    constexpr int most = 4;
    const int n = std::min((in.shown_px.x + in.traced_px.x - 1) / in.traced_px.x, most);
    constexpr int strides[most] = {1, 3, 4, 7};  // without a common divisor with n^2
    const int stride = strides[n - 1];
    const int place = static_cast<int>(in.frame_index % static_cast<std::uint32_t>(n * n)) * stride % (n * n);
    return (glm::vec2(place % n, place / n) + 0.5f) / static_cast<float>(n);
}

}  // namespace

FrameBlock make_frame_block(const FrameInputs& in) {
    const Settings& s = in.settings;
    FrameBlock block;
    const CameraBasis basis = camera_basis(s.camera_yaw_deg, s.camera_pitch_deg);
    // In double precision: near 90 degrees a tangent enlarges the rounding of its angle by its square.
    const double half = std::tan(glm::radians(static_cast<double>(s.camera_fov_deg)) / 2);
    const double aspect = static_cast<double>(in.shown_px.x) / in.shown_px.y;
    block.camera_position_vox = glm::vec4(s.camera_position_vox, 0);
    block.camera_dir = glm::vec4(basis.dir, 0);
    block.camera_right = glm::vec4(basis.right * static_cast<float>(half * aspect), 0);
    block.camera_up = glm::vec4(basis.up * static_cast<float>(half), 0);
    set_previous_eye(block, block);
    block.world_size_vox = glm::ivec4(in.world_size_vox, 0);
    block.counters = {in.frame_index, in.seed, static_cast<std::uint32_t>(s.samples_per_pixel),
                      in.frames_kept};
    set_sun(block, s);
    block.sky_zenith = glm::vec4(s.sky_zenith, 0);
    block.sky_horizon = glm::vec4(s.sky_horizon, 0);
    block.trace_limits = {s.max_distance_vox, in.metres_per_voxel, s.firefly_limit, 0};
    int options = 0;
    if (s.sun_through_water) options |= OPTION_SUN_THROUGH_WATER;
    if (s.caustics) options |= OPTION_CAUSTICS;
    if (s.diffuse_sampling == DiffuseSampling::Uniform) options |= OPTION_UNIFORM_DIFFUSE;
    if (s.jitter) options |= OPTION_JITTER;
    if (s.low_discrepancy) options |= OPTION_LOW_DISCREPANCY;
    if (s.straight_sunlight) options |= OPTION_STRAIGHT_SUNLIGHT;
    if (in.scattered) options |= OPTION_SCATTER;
    if (s.history == History::Count || s.history == History::Blend) options |= OPTION_IMAGE_DISTANCE;
    if (s.sky_model == SkyModel::Preetham) {
        set_clear_sky(block, s);
        options |= OPTION_PREETHAM_SKY;
    }
    block.trace_options = {s.max_bounces, s.roulette_after, s.max_diffuse_bounces, options};
    block.size_px = {in.traced_px, in.shown_px};
    block.history = {s.history_alpha, static_cast<float>(s.history_cap), place_in_cell(in)};
    block.display = {std::exp2(s.exposure_ev), s.tone_map == ToneMap::Linear ? 1.0f : 0.0f, 0, 0};
    return block;
}

void set_previous_eye(FrameBlock& now, const FrameBlock& before) {
    now.previous_position_vox = before.camera_position_vox;
    now.previous_dir = before.camera_dir;
    now.previous_right = before.camera_right;
    now.previous_up = before.camera_up;
}

std::array<MaterialBlockEntry, MATERIAL_COUNT> make_material_block(const MaterialTable& table) {
    std::array<MaterialBlockEntry, MATERIAL_COUNT> entries{};
    std::transform(table.begin(), table.end(), entries.begin(), [](const Material& m) {
        return MaterialBlockEntry{glm::vec4(m.base_color, m.roughness), glm::vec4(m.absorption_per_m, m.ior),
                                  glm::vec4(m.emission, m.metallic)};
    });
    return entries;
}

}  // namespace tarn
