#include "cli/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/app.h"
#include "app/stats.h"
#include "cli/arguments.h"
#include "cli/bench_command.h"
#include "cli/doctor.h"
#include "cli/light_command.h"
#include "cli/path_command.h"
#include "cli/progress.h"
#include "cli/ticks.h"
#include "cli/tradeoff_command.h"
#include "cli/water_command.h"
#include "core/error.h"
#include "core/files.h"
#include "platform/platform.h"
#include "world/npy.h"

namespace tarn {

namespace {

constexpr glm::ivec2 default_size_px{640, 360};

glm::ivec2 picture_size(const Arguments& arguments) {
    return arguments.size_px == glm::ivec2(0) ? default_size_px : arguments.size_px;
}

void check_outputs(const Arguments& arguments) {
    for (const std::string* path : {&arguments.out, &arguments.stats, &arguments.cells, &arguments.amounts}) {
        if (!path->empty()) check_writable(*path);
    }
}

bool is_exr(const std::string& path) {
    return std::filesystem::path(path).extension() == ".exr";
}

void write_picture(const std::string& path, const Renderer& renderer) {
    if (is_exr(path))
        write_exr(path, renderer.read_radiance());
    else
        write_png(path, renderer.read_picture());
}

void render_to(const Arguments& arguments, Scene scene) {
    const Settings settings = scene.settings;
    const glm::ivec2 size = picture_size(arguments);
    if (arguments.exact && arguments.spp % settings.samples_per_pixel != 0)
        fail("--spp {}: not a multiple of samples_per_pixel={}; allowed: a multiple of it", arguments.spp,
             settings.samples_per_pixel);
    int frames = arguments.frames;
    if (arguments.exact) frames = arguments.spp / settings.samples_per_pixel;
    const auto platform = make_headless(size, frames);
    App app(std::move(scene), settings, {.interactive = false, .platform = platform.get()});
    run_ticks(app.simulation(), settings, arguments.ticks, app.timers());
    {
        Progress progress("frames", static_cast<std::uint64_t>(frames));
        std::uint64_t done = 0;
        while (const auto input = platform->next_frame()) {
            platform->present(app.frame(*input));
            progress.show(++done);
        }
    }
    write_picture(arguments.out, app.renderer());
    if (!arguments.stats.empty()) write_file(arguments.stats, app.stats_json());
}

int run_render(const Arguments& arguments) {
    const std::string extension = std::filesystem::path(arguments.out).extension();
    if (extension != ".png" && extension != ".exr")
        fail("--out {}: unknown kind of picture; allowed: a name ending in .png or .exr", arguments.out);
    if (!arguments.path.empty()) return render_path(arguments, picture_size(arguments));
    if (arguments.strip) fail("--strip: of the frames of a recording; give --path too");
    check_outputs(arguments);
    render_to(arguments, scene_of(arguments));
    return 0;
}

int run_simulate(const Arguments& arguments) {
    for (const auto& [option, path] :
         {std::pair("--cells", &arguments.cells), std::pair("--amounts", &arguments.amounts)}) {
        if (!path->empty() && std::filesystem::path(*path).extension() != ".npy")
            fail("{} {}: unknown kind of file; allowed: a name ending in .npy", option, *path);
    }
    check_outputs(arguments);
    const Scene scene = scene_of(arguments);
    const auto platform = make_headless({1, 1}, 0);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    run_ticks(simulation, scene.settings, arguments.ticks, timers);
    if (!arguments.cells.empty() || !arguments.amounts.empty()) {
        const Cells cells = simulation.read_cells();
        if (!arguments.cells.empty()) write_npy(arguments.cells, cells);
        if (!arguments.amounts.empty()) write_amounts_npy(arguments.amounts, cells);
    }
    const std::string stats =
        stats_json({.scene = scene, .simulation = simulation, .settings = scene.settings, .timers = timers});
    if (!arguments.stats.empty()) write_file(arguments.stats, stats);
    if (arguments.stats.empty() && arguments.cells.empty() && arguments.amounts.empty())
        fmt::print("{}", stats);
    return 0;
}

int run_play(Arguments arguments) {
    check_outputs(arguments);
    Scene scene = scene_of(arguments);
    if (!has_display()) {
        arguments.out = fmt::format("tarn-{}.png", scene.name);
        fmt::print("tarn: no display (DISPLAY leads nowhere): rendering {} to {} instead\n", scene.name,
                   arguments.out);
        check_writable(arguments.out);
        arguments.frames = 64;
        render_to(arguments, std::move(scene));
        return 0;
    }
    const auto platform = make_window(picture_size(arguments), "Tarn");
    const Settings settings = scene.settings;
    App app(std::move(scene), settings, {.interactive = true, .platform = platform.get()});
    while (const auto input = platform->next_frame()) platform->present(app.frame(*input));
    if (!arguments.stats.empty()) write_file(arguments.stats, app.stats_json());
    return 0;
}

int run_scenes() {
    for (const SceneSummary& scene : builtin_scenes())
        fmt::print("{:<12} {}\n", scene.name, scene.description);
    return 0;
}

int run_settings() {
    Settings defaults;
    apply_quality(defaults, Quality::Balanced);
    for (const SettingInfo& info : setting_infos()) {
        fmt::print("{:<24} {} (default {})\n{:<24} {}: {}\n", info.name, allowed_values(info),
                   setting_text(defaults, info), "", group_name(info.group), info.help);
    }
    return 0;
}

}  // namespace

int run_command_line(int argc, char** argv) {
    const auto arguments = parse_arguments(argc, argv);
    if (!arguments) return 0;
    if (arguments->command == "play") return run_play(*arguments);
    if (arguments->command == "render") return run_render(*arguments);
    if (arguments->command == "simulate") return run_simulate(*arguments);
    if (arguments->command == "water") return run_water_command(*arguments);
    if (arguments->command == "light") return run_light_command(*arguments);
    if (arguments->command == "bench") return run_bench_command(*arguments);
    if (arguments->command == "tradeoff") return run_tradeoff_command(*arguments);
    if (arguments->command == "scenes") return run_scenes();
    if (arguments->command == "settings") return run_settings();
    return run_doctor();
}

}  // namespace tarn
