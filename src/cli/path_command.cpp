#include "cli/path_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/renderer.h"
#include "app/replay.h"
#include "app/stats.h"
#include "cli/progress.h"
#include "cli/ticks.h"
#include "core/error.h"
#include "core/files.h"
#include "platform/platform.h"
#include "world/recording.h"

namespace tarn {

namespace {

namespace fs = std::filesystem;

constexpr int strip_columns = 6;
// As of pictures (arguments.cpp), and for PNG's encoder.
constexpr std::int64_t strip_area_max_px = std::int64_t{1} << 25;

std::string numbered(const std::string& out, int frame) {
    const fs::path path = out;
    return (path.parent_path() /
            fmt::format("{}-{:04}{}", path.stem().string(), frame, path.extension().string()))
        .string();
}

class Strip {
  public:
    Strip(glm::ivec2 size_px, int frames) : frame_px_(size_px) {
        const int columns = std::min(frames, strip_columns);
        const int rows = (frames + columns - 1) / columns;
        if (std::int64_t{columns} * size_px.x * rows * size_px.y > strip_area_max_px)
            fail("--strip: {} frames of {}x{} are too many pixels; allowed: {} in all", frames, size_px.x,
                 size_px.y, strip_area_max_px);
        image_ = {columns * size_px.x, rows * size_px.y, {}};
        image_.pixels.assign(std::size_t{4} * image_.width * image_.height, 0);
    }
    void add(const ImageRgba8& picture, int frame) {
        const std::size_t row_bytes = std::size_t{4} * frame_px_.x;
        const int left = frame % strip_columns * frame_px_.x;
        const int top = frame / strip_columns * frame_px_.y;
        for (int y = 0; y < frame_px_.y; ++y)
            std::copy_n(
                picture.pixels.begin() + static_cast<std::ptrdiff_t>(y * row_bytes), row_bytes,
                image_.pixels.begin() + (std::ptrdiff_t{top + y} * image_.width + left) * std::ptrdiff_t{4});
    }
    const ImageRgba8& image() const { return image_; }

  private:
    glm::ivec2 frame_px_;
    ImageRgba8 image_;
};

}  // namespace

int render_path(const Arguments& arguments, glm::ivec2 size_px) {
    const Recording recording = load_recording(arguments.path);
    const bool exr = fs::path(arguments.out).extension() == ".exr";
    if (arguments.strip && exr) fail("--strip --out {}: a strip is a PNG; allowed: .png", arguments.out);
    std::optional<Strip> strip;
    if (arguments.strip) strip.emplace(size_px, recording.frames());
    check_writable(arguments.strip ? arguments.out : numbered(arguments.out, recording.frames() - 1));
    if (!arguments.stats.empty()) check_writable(arguments.stats);
    const Scene scene = scene_of(arguments);
    Settings settings = scene.settings;
    if (arguments.exact && arguments.spp % settings.samples_per_pixel != 0)
        fail("--spp {}: not a multiple of samples_per_pixel={}; allowed: a multiple of it", arguments.spp,
             settings.samples_per_pixel);

    const auto platform = make_headless(size_px, 0);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    run_ticks(simulation, settings, arguments.ticks, timers);
    EditHistory history;
    const int renders = arguments.exact ? arguments.spp / settings.samples_per_pixel : 1;
    const auto draw = [&] {
        for (int i = 0; i < renders; ++i) {
            renderer.render(simulation, settings, size_px);
            timers.end_frame();
        }
    };
    place_camera(recording, 0, scene.settings, settings);
    for (int i = 0; i < recording.lead_frames && !arguments.exact; ++i) draw();
    Progress progress("frames", static_cast<std::uint64_t>(recording.frames()));
    for (int frame = 0; frame < recording.frames(); ++frame) {
        place_camera(recording, frame, scene.settings, settings);
        play_world(recording, frame, scene.settings, simulation, settings, history);
        if (arguments.exact) renderer.reset_history();
        draw();
        if (strip)
            strip->add(renderer.read_picture(), frame);
        else if (exr)
            write_exr(numbered(arguments.out, frame), renderer.read_radiance());
        else
            write_png(numbered(arguments.out, frame), renderer.read_picture());
        progress.show(static_cast<std::uint64_t>(frame) + 1);
    }
    if (strip) write_png(arguments.out, strip->image());
    if (!arguments.stats.empty())
        write_file(arguments.stats, stats_json({.scene = scene,
                                                .simulation = simulation,
                                                .settings = settings,
                                                .timers = timers,
                                                .compile_ms = renderer.compile_ms(),
                                                .rejected_samples = renderer.rejected_samples(),
                                                .samples = renderer.samples()}));
    return 0;
}

}  // namespace tarn
