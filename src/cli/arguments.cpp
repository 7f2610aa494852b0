#include "cli/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <limits>

#include "cli/bench_command.h"
#include "cli/tradeoff_command.h"
#include "core/error.h"
#include "measure/light_table.h"
#include "measure/water_scenarios.h"
#include "world/recording.h"

namespace tarn {

namespace {

constexpr int picture_side_max_px = 16384;
// 8K: its targets take some 4.5 GB, and no read-back passes 2^31 bytes.
constexpr std::int64_t picture_area_max_px = std::int64_t{1} << 25;
constexpr std::int64_t ticks_max = 1'000'000'000'000;

glm::ivec2 parse_size(const std::string& text) {
    const char* const end = text.data() + text.size();
    glm::ivec2 size(0);
    const auto first = std::from_chars(text.data(), end, size.x);
    bool ok = first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x';
    if (ok) {
        const auto second = std::from_chars(first.ptr + 1, end, size.y);
        ok = second.ec == std::errc{} && second.ptr == end;
    }
    if (!ok || std::min(size.x, size.y) < 1 || std::max(size.x, size.y) > picture_side_max_px)
        fail("--size {}: not a picture size; allowed: WIDTHxHEIGHT, each 1 to {}", text, picture_side_max_px);
    if (std::int64_t{size.x} * size.y > picture_area_max_px)
        fail("--size {}: too many pixels; allowed: WIDTHxHEIGHT, each 1 to {}, of {} in all", text,
             picture_side_max_px, picture_area_max_px);
    return size;
}

void apply_camera(const std::string& text, Settings& settings) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        parts.push_back(text.substr(begin, comma - begin));
        begin = comma + 1;
    }
    if (parts.size() != 5 && parts.size() != 6)
        fail("--camera {}: {} numbers given; allowed: x,y,z,yaw,pitch or x,y,z,yaw,pitch,fov", text,
             parts.size());
    try {
        set_setting(settings, "camera_position_vox", parts[0] + "," + parts[1] + "," + parts[2]);
        set_setting(settings, "camera_yaw_deg", parts[3]);
        set_setting(settings, "camera_pitch_deg", parts[4]);
        if (parts.size() == 6) set_setting(settings, "camera_fov_deg", parts[5]);
    } catch (const Error& error) {
        fail("--camera {}: {}", text, error.what());
    }
}

void apply_view(const std::string& text, Settings& settings) {
    const auto names = choice_names<ViewKind>();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end())
        fail("--view {}: no such view; allowed: one of {}", text, fmt::join(names, ", "));
    settings.view = static_cast<ViewKind>(found - names.begin());
}

void path_options(CLI::App* render, Arguments& arguments, CLI::Option* frames) {
    auto* path = render->add_option(
        "--path", arguments.path,
        "Play a recording, a built-in name below or a file ending in .json, in the scene; writes "
        "F-0000.png, F-0001.png, ...");
    path->excludes(frames);
    render
        ->add_flag("--strip", arguments.strip,
                   "All frames of the recording in one PNG, six in a row, from left to right")
        ->needs(path);
    render->footer(fmt::format(
        "Recordings: {}.\n"
        "A recording is a file of JSON for any scene: the scene is --scene, its world after --ticks. Keys:\n"
        "  camera           relative: positions are right, up, ahead of the scene's camera, angles are turns "
        "from it;\n"
        "                   absolute: as in --camera\n"
        "  frames           how many\n"
        "  lead_frames      before the first, with its camera and without ticks, not written (0)\n"
        "  ticks_per_frame  a number, or a list with one for each frame (0)\n"
        "  keys             list of {{frame, position_vox, yaw_deg, pitch_deg, fov_deg}}, the first at frame "
        "0; straight\n"
        "                   between them\n"
        "  edits            list of {{frame, center_vox, shape (sphere, cube), radius_vox, material, "
        "overwrite,\n"
        "                   begins (a stroke)}}, and of {{frame, stroke (undo, redo)}}\n"
        "With --exact each frame is the mean of --spp samples.",
        fmt::join(builtin_recordings(), ", ")));
}

void water_options(CLI::App* water, Arguments& arguments) {
    water->add_option("--tier", arguments.tiers,
                      fmt::format("Tiers of the water, separated by commas (all): {}",
                                  fmt::join(choice_names<WaterTier>(), ", ")));
    water->add_option("--scenario", arguments.scenarios, "Scenarios below, separated by commas (all)");
    water->add_option("--seeds", arguments.seeds, "Seeds 1 to N; the table has the typical and the worst (1)")
        ->check(CLI::Range(1, 1000));
    water->add_option("--ticks", arguments.ticks, "At most so many ticks a run, in place of a scenario's own")
        ->check(CLI::Range(1, 1000000));
    water->add_option("--set", arguments.set, "key=value, repeatable; see `tarn settings`")
        ->allow_extra_args(false);
    water->add_option("--out", arguments.out, "Folder for water.csv and water.svg; made where it is missing");
    water->add_flag("--reference", arguments.reference, "Step the serial CPU reference in place of the GPU");
    water->add_flag(
        "--speed", arguments.speed,
        "Time the ticks of each tier instead: a burst dam, a still pool awake and asleep; minutes");
    water
        ->add_option("--sides", arguments.sides_vox, "Sides of the worlds of --speed, in voxels (64,128,256)")
        ->delimiter(',')
        ->check(CLI::Range(16, 512));
    water->add_flag("--awake", arguments.awake, "Step every brick always, those at rest too");
    std::string footer = "Scenarios:\n";
    for (const WaterScenario& scenario : water_scenarios())
        footer += fmt::format("  {:<9} {}\n", scenario.name, scenario.what);
    footer += "Exit code 1: water or sand was lost or made. A missed target is in the table alone.";
    water->footer(footer);
}

void light_options(CLI::App* light, Arguments& arguments) {
    light->add_option("--scenario", arguments.scenarios, "Scenarios below, separated by commas (all)");
    light
        ->add_option("--rounds", arguments.rounds,
                     "Independent pictures by each strategy, taken in turn (12)")
        ->check(CLI::Range(2, 100000));
    light->add_option("--spp", arguments.spp_of_round, "Samples per pixel of a round (8)")
        ->check(CLI::Range(1, 100000));
    light
        ->add_option("--set", arguments.set, "key=value over all strategies, repeatable; see `tarn settings`")
        ->allow_extra_args(false);
    light->add_option("--out", arguments.out, "Folder for light.csv; made where it is missing");
    std::string footer = "Scenarios:\n";
    for (const LightScenario& scenario : light_scenarios())
        footer += fmt::format("  {:<9} {}\n", scenario.name, scenario.what);
    footer +=
        "off_by: distance of a mean from the first strategy's, in standard errors. equal_time_gain: variance "
        "times\n"
        "time of the first strategy over this one's. Exit code 1: a mean is off by more than 4, or a sample "
        "was not\n"
        "finite.";
    light->footer(footer);
}

void bench_options(CLI::App* bench, Arguments& arguments, std::string& size) {
    bench->add_option(
        "--suite", arguments.suites,
        fmt::format("Suites below, separated by commas (all): {}", fmt::join(bench_suites(), ", ")));
    bench->add_option("--sizes", arguments.bench_sides_vox, "Sides of the terrain, in voxels (128,256,512)")
        ->delimiter(',')
        ->check(CLI::Range(16, 1024));
    bench->add_option("--size", size,
                      "Picture of the frames, WIDTHxHEIGHT (640x360 and 1280x720; bars are for the first)");
    bench
        ->add_option("--repeats", arguments.repeats,
                     "Rounds, taken in turn by all that is compared; what is slow takes part in fewer (5)")
        ->check(CLI::Range(1, 1000));
    bench->add_option("--out", arguments.out,
                      "Folder for bench.json and bench.csv; made where it is missing");
    auto* compare = bench->add_option("--compare", arguments.compare,
                                      "bench.json of an earlier run: prints the ratios of this one to it");
    bench->add_option("--with", arguments.with, "bench.json of another run, in place of a run now")
        ->needs(compare);
    bench->footer(
        "Suites:\n"
        "  rays   primary, diffuse, in-water and shadow rays a second: Tarn (tarn), Tarn without skipping "
        "(voxel),\n"
        "         Embree's packets and single rays (embree-8, embree-1), where it is built in\n"
        "  frame  frames of every quality at 640x360 and 1280x720, and their passes\n"
        "  sim    ticks: all awake, a tenth awake, asleep; all of it on the CPU's threads, with and without "
        "AVX2;\n"
        "         both again under tier block; a world of 64^3 asleep; a copy of the cells' bytes\n"
        "  edit   strokes of the brush of radius 1, 8 and 32\n"
        "  start  the program's start to its first frame, with empty and with filled caches of shaders; peak "
        "memory\n"
        "  variants\n"
        "         frames with code compiled in that their scene has no need of, against the same without; "
        "smallest "
        "size\n"
        "Medians and the spread between quartiles; `bars` are ratios within the run. Exit code 1: "
        "contestants do\n"
        "not find the same, or a world does not come to rest.");
}

void tradeoff_options(CLI::App* tradeoff, Arguments& arguments, std::string& size) {
    tradeoff->add_flag("--quick", arguments.quick,
                       "One scene and few configurations: minutes in place of hours");
    tradeoff->add_option(
        "--part", arguments.suites,
        fmt::format("Parts, separated by commas (all): {}", fmt::join(tradeoff_parts(), ", ")));
    tradeoff->add_option("--scene", arguments.scenarios,
                         fmt::format("Scenes, separated by commas (all; --quick: lake): {}",
                                     fmt::join(tradeoff_scenes(), ", ")));
    tradeoff->add_option("--out", arguments.out,
                         "Folder for tradeoff.csv, charts and references; made where it is missing");
    tradeoff->add_flag("--resume", arguments.resume,
                       "Go on with the rows in --out that this very program wrote, asked the same");
    tradeoff->add_option("--size", size,
                         "Size of the timed pictures, WIDTHxHEIGHT (640x360), at least 32x16; errors are of "
                         "a quarter of it each way");
    tradeoff->add_flag("--report", arguments.report,
                       "Measure nothing: tables and charts of the rows in --out again");
    tradeoff->add_option(
        "--write-front", arguments.write_front,
        "Write the front for the slider and the governor; the program's is assets/front.json");
    tradeoff->add_option("--configurations", arguments.configurations, "At most so many (200; --quick: 10)")
        ->check(CLI::Range(1, 200));
    tradeoff
        ->add_option("--reference-samples", arguments.reference_samples,
                     "At most so many per pixel of a reference (512; --quick: 256)")
        ->check(CLI::Range(4, 1 << 20));
    tradeoff->footer(
        "Errors are relMSE of the luminance at 160x90 over the recordings still, flying and moving-water, "
        "each "
        "frame\n"
        "against its own reference in quality exact; times are of a frame at 640x360, all of a batch and "
        "balanced in\n"
        "turn. A coordinate search from the qualities. floor: the reference's own relMSE; a row within 3 "
        "times "
        "it\n"
        "chooses nothing. bias: the error that endless samples would leave. A run that was interrupted goes "
        "on "
        "with\n"
        "--resume. Exit code 1: a sample was not finite.");
}

// CLI11 spreads its help over lines; an error is one.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

}  // namespace

std::optional<Arguments> parse_arguments(int argc, char** argv) {
    Arguments arguments;
    std::string size;
    CLI::App app{"Tarn: a path-traced voxel sandbox with water as its heart.", "tarn"};
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0; 1 a check failed; 2 bad input. `tarn COMMAND --help` explains a command.\n"
        "Compiled programs are kept in $XDG_CACHE_HOME/tarn or ~/.cache/tarn, at most 64 MiB; "
        "TARN_PROGRAM_CACHE=off keeps and reads none.");
    app.set_version_flag("--version", TARN_VERSION);

    const auto scene_options = [&](CLI::App* command, bool required) {
        auto* option = command->add_option(
            "--scene", arguments.scene, "Built-in name (see `tarn scenes`) or a scene file ending in .json");
        if (required) option->required();
        command->add_option("--seed", arguments.seed, "Seed in place of the scene's")
            ->check(CLI::Range(std::int64_t{0}, std::int64_t{std::numeric_limits<std::uint32_t>::max()}));
        command->add_option("--set", arguments.set, "key=value, repeatable; see `tarn settings`")
            ->allow_extra_args(false);
    };
    const auto picture_options = [&](CLI::App* command) {
        command->add_option("--size", size, "Picture size in pixels, WIDTHxHEIGHT");
        command->add_option("--quality", arguments.quality,
                            "Preset: baseline, fast, balanced, quality, exact");
    };

    CLI::App* play =
        app.add_subcommand("play", "Open the window (headless: render the scene to tarn-SCENE.png)");
    scene_options(play, false);
    picture_options(play);
    play->add_option("--stats", arguments.stats,
                     "Write counts, times and settings as JSON when the window closes");

    CLI::App* render = app.add_subcommand("render", "Make a picture without a window");
    scene_options(render, true);
    picture_options(render);
    render->add_option("--out", arguments.out, "F.png (tone-mapped sRGB) or F.exr (linear radiance)")
        ->required();
    render->add_option("--ticks", arguments.ticks, "Simulation ticks before the first frame")
        ->check(CLI::Range(std::int64_t{0}, ticks_max));
    auto* frames =
        render
            ->add_option("--frames", arguments.frames, "Frames, with history and filter; the last is written")
            ->check(CLI::Range(1, 1000000));
    auto* exact =
        render->add_flag("--exact", arguments.exact, "The unbiased mean over the pixel; quality exact");
    exact->excludes(frames);
    render->add_option("--spp", arguments.spp, "Samples per pixel of --exact (64)")
        ->check(CLI::Range(1, 100000000))
        ->needs(exact);
    render->add_option("--view", arguments.view,
                       fmt::format("In place of the picture: {} (PNG: false colours, EXR: raw values)",
                                   fmt::join(choice_names<ViewKind>(), ", ")));
    render->add_option("--camera", arguments.camera, "x,y,z,yaw,pitch[,fov] in place of the scene's");
    render->add_option("--stats", arguments.stats, "Write counts, times and settings as JSON");
    path_options(render, arguments, frames);

    CLI::App* simulate = app.add_subcommand("simulate", "Run the simulation without a picture");
    scene_options(simulate, true);
    simulate->add_option("--ticks", arguments.ticks, "Simulation ticks")
        ->required()
        ->check(CLI::Range(std::int64_t{0}, ticks_max));
    simulate->add_option("--cells", arguments.cells, "Write material ids as .npy: uint8, shape (z, y, x)");
    simulate->add_option("--amounts", arguments.amounts,
                         "Write quanta of water (sixteenths of a voxel, 0 to 16) as .npy of the same shape");
    simulate->add_option("--stats", arguments.stats, "Write counts, times and settings as JSON");

    CLI::App* water = app.add_subcommand(
        "water", "Measure the water: levelling, rest, pressure, roundness, sand, mass at every tick");
    water_options(water, arguments);

    CLI::App* light = app.add_subcommand(
        "light", "Measure the ways of finding light: means, variances and times of strategies side by side");
    light_options(light, arguments);

    CLI::App* bench = app.add_subcommand(
        "bench",
        "Measure speed: rays, frames, ticks, edits and starts, each beside what it is compared with");
    bench_options(bench, arguments, size);

    CLI::App* tradeoff = app.add_subcommand(
        "tradeoff", "Measure the trade of speed for accuracy: time against error, and the best of both");
    tradeoff_options(tradeoff, arguments, size);

    app.add_subcommand("scenes", "List the built-in scenes");
    app.add_subcommand("settings", "List every setting: key, range, default, help");
    app.add_subcommand("doctor", "Check the driver and run a self-test; exit code 0 or 1");

    const auto named = [&](const CLI::App* command) { return command->check_name(argv[1]); };
    if (argc > 1 && *argv[1] != '-' && app.get_subcommands(named).empty())
        fail(
            "{}: no such command; allowed: play, render, simulate, water, light, bench, tradeoff, scenes, "
            "settings, doctor",
            argv[1]);
    for (CLI::App* command : app.get_subcommands({}))
        for (CLI::Option* option : command->get_options())
            if (option->get_expected_min() > 0)
                option->check(CLI::Validator(
                    [](const std::string& value) { return value.empty() ? std::string("empty") : ""; }, ""));
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        app.exit(help);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        fail("{}; `tarn --help` and `tarn COMMAND --help` list what is allowed", one_line(error.what()));
    }
    arguments.command = app.get_subcommands().front()->get_name();
    if (arguments.configurations == 0) arguments.configurations = arguments.quick ? 10 : 200;
    if (arguments.reference_samples == 0) arguments.reference_samples = arguments.quick ? 256 : 512;
    if (!size.empty()) arguments.size_px = parse_size(size);
    return arguments;
}

Scene scene_of(const Arguments& arguments) {
    Settings base;
    apply_quality(base, Quality::Balanced);
    if (arguments.quality) set_setting(base, "quality", *arguments.quality);
    if (arguments.exact) {
        if (arguments.quality && base.quality != Quality::Exact)
            fail("--quality {}: --exact implies quality exact; leave one of them out", *arguments.quality);
        apply_quality(base, Quality::Exact);
    }
    // Assignments are tried before the scene is built: a typing error should not cost a terrain.
    Settings trial = base;
    for (const std::string& assignment : arguments.set) set_assignment(trial, assignment);
    if (!arguments.camera.empty()) apply_camera(arguments.camera, trial);
    if (arguments.view) apply_view(*arguments.view, trial);
    if (arguments.exact && trial.history != History::Exact)
        fail("--set: --exact needs history=exact; render without --exact for another");

    Scene scene = load_scene(arguments.scene, base, arguments.seed);
    for (const std::string& assignment : arguments.set) set_assignment(scene.settings, assignment);
    if (!arguments.camera.empty()) apply_camera(arguments.camera, scene.settings);
    if (arguments.view) apply_view(*arguments.view, scene.settings);
    return scene;
}

}  // namespace tarn
