// What the app tells the world about itself: its statistics and its screenshots.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/app.h"
#include "app/stats.h"
#include "core/error.h"
#include "core/files.h"
#include "gl/context.h"

namespace tarn {

namespace {

using Json = nlohmann::ordered_json;

constexpr int screenshots_max = 9999;

}  // namespace

std::string App::stats_json() {
    Json stats = Json::parse(tarn::stats_json({.scene = scene_,
                                               .simulation = *simulation_,
                                               .settings = settings_,
                                               .timers = timers_,
                                               .compile_ms = renderer_->compile_ms(),
                                               .rejected_samples = renderer_->rejected_samples(),
                                               .samples = frames_ > 0 ? renderer_->samples() : 0}));
    stats["frames"] = frames_;
    gl::collect_errors();
    stats["gl_errors"] = gl::debug_log().messages;
    if (options_.interactive) {
        stats["brush"] = {{"material", material_name(tools_.brush.material)},
                          {"shape", tools_.brush.shape == BrushShape::Sphere ? "sphere" : "cube"},
                          {"radius_vox", tools_.brush.radius_vox},
                          {"overwrite", tools_.brush.overwrite}};
        stats["panels_shown"] = {{"help", panels_.help_was_shown()},
                                 {"settings", panels_.settings_was_shown()}};
    }
    return stats.dump(2) + "\n";
}

void App::write_screenshot() {
    try {
        for (int n = 1; n <= screenshots_max; ++n) {
            const std::filesystem::path png = fmt::format("tarn-{:04}.png", n);
            const std::filesystem::path json = fmt::format("tarn-{:04}.json", n);
            if (std::filesystem::exists(png) || std::filesystem::exists(json)) continue;
            const Json about = {{"scene", scene_.name},
                                {"seed", scene_.seed},
                                {"tick", simulation_->tick()},
                                {"samples", renderer_->samples()},
                                {"settings", Json::parse(settings_json(settings_))}};
            write_png(png, renderer_->read_picture());
            write_file(json, about.dump(2) + "\n");
            say(fmt::format("wrote {}", (std::filesystem::current_path() / png).string()));
            return;
        }
        fail("tarn-{:04}.png: this folder holds that many pictures already", screenshots_max);
    } catch (const std::exception& error) {
        say(error.what());
    }
}

void App::start_or_stop_recording() {
    if (!recorder_.is_on()) {
        recorder_.start(scene_.name, simulation_->tick());
        say("recording");
        return;
    }
    const auto recording = recorder_.stop();
    if (!recording) return;
    try {
        for (int n = 1; n <= screenshots_max; ++n) {
            const std::filesystem::path file = fmt::format("tarn-{:04}.flight.json", n);
            if (std::filesystem::exists(file)) continue;
            write_file(file, recording_json(*recording));
            say(fmt::format("wrote {}: {} frames", (std::filesystem::current_path() / file).string(),
                            recording->frames()));
            return;
        }
        fail("tarn-{:04}.flight.json: this folder holds that many recordings already", screenshots_max);
    } catch (const std::exception& error) {
        say(error.what());
    }
}

void App::end_recording() {
    if (recorder_.is_on()) start_or_stop_recording();
}

}  // namespace tarn
