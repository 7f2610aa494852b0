#include "cli/doctor.h"

#include <fmt/format.h>

#include <cmath>

#include "app/app.h"
#include "core/error.h"
#include "gl/context.h"
#include "platform/platform.h"
#include "reference/simulation.h"

namespace tarn {

namespace {

struct Limit {
    const char* what;
    GLenum name;
    std::int64_t needed;
};

// What the passes use (texture sides for the largest world and picture).
constexpr Limit limits[] = {
    {"3D texture side", GL_MAX_3D_TEXTURE_SIZE, world_side_max_vox},
    {"2D texture side", GL_MAX_TEXTURE_SIZE, 16384},
    {"compute invocations in a group", GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, 256},
    {"image units in compute", GL_MAX_COMPUTE_IMAGE_UNIFORMS, 4},
    {"image units in fragments", GL_MAX_FRAGMENT_IMAGE_UNIFORMS, 6},
    {"images, storage blocks and outputs of a program", GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES, 10},
    {"storage blocks in compute", GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 4},
    {"storage blocks in fragments", GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, 1},
    {"uniform block bytes", GL_MAX_UNIFORM_BLOCK_SIZE, 16384},
    {"texture units in fragments", GL_MAX_TEXTURE_IMAGE_UNITS, 12},
    {"colour attachments", GL_MAX_COLOR_ATTACHMENTS, 4},
};

bool report(bool ok, const std::string& text) {
    fmt::print("{:<5} {}\n", ok ? "ok" : "FAIL", text);
    return ok;
}

bool check_limits() {
    bool ok = true;
    for (const Limit& limit : limits) {
        GLint64 value = 0;
        glGetInteger64v(limit.name, &value);
        ok = report(value >= limit.needed,
                    fmt::format("{}: {} (needs {})", limit.what, value, limit.needed)) &&
             ok;
    }
    return ok;
}

// Ticks of a scene with water in motion: the GPU's cells against the CPU reference's.
bool check_water() {
    constexpr int ticks = 20;
    const Scene scene = load_scene("dam-break", Settings{});
    gl::Timers timers;
    Simulation simulation(scene, timers);
    simulation.step(ticks, scene.settings);
    reference::Simulation reference(scene);
    reference.step(ticks, scene.settings);
    return report(simulation.read_cells() == reference.cells(),
                  fmt::format("water: {} ticks equal the CPU reference", ticks));
}

// A closed box whose walls reflect and emit one half: n bounces give 1 - 0.5^(n+1).
bool check_light(Platform& platform) {
    Settings base;
    apply_quality(base, Quality::Exact);
    Scene scene = load_scene("furnace", base);
    scene.settings.light_sampling = LightSampling::None;
    scene.settings.roulette_after = 1024;
    scene.settings.max_bounces = 5;
    const Settings settings = scene.settings;
    App app(std::move(scene), settings, {.interactive = false, .platform = &platform});
    while (const auto input = platform.next_frame()) platform.present(app.frame(*input));
    const float expected = 1 - std::pow(0.5f, 6.0f);
    float worst = 0;
    for (const float value : app.renderer().read_radiance().pixels)
        worst = std::max(worst, std::abs(value - expected));
    return report(worst < 1e-5f, fmt::format("light: the furnace returns {} within {:.1e}", expected, worst));
}

}  // namespace

int run_doctor() {
    std::unique_ptr<Platform> platform;
    try {
        platform = make_headless({32, 32}, 1);
    } catch (const Error& error) {
        report(false, error.what());
        return 1;
    }
    const gl::DriverInfo driver = gl::driver_info();
    fmt::print("driver {} / {} / {}\n", driver.vendor, driver.renderer, driver.version);
    bool ok = check_limits();
    ok = check_water() && ok;
    ok = check_light(*platform) && ok;
    gl::collect_errors();
    const bool clean = gl::debug_log().high_severity == 0;
    ok = report(clean, clean ? "no OpenGL error" : gl::debug_log().messages.front()) && ok;
    return ok ? 0 : 1;
}

}  // namespace tarn
