#include "measure/tradeoff_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/replay.h"
#include "core/error.h"

namespace tarn {

namespace {

// Frame numbers, from which random numbers follow: none is used twice.
constexpr std::uint64_t runs_from = 0;
constexpr std::uint64_t run_frames = std::uint64_t{1} << 20;
constexpr std::uint64_t halves_from = std::uint64_t{1} << 30;
constexpr std::uint64_t half_frames = std::uint64_t{1} << 30;
// A frame of every recording has so many of its own.
constexpr std::uint64_t reference_frames = std::uint64_t{1} << 20;

// Frames of a turn when times are taken, after one that makes the targets; fewer where they are slow.
constexpr int frames_of_turn = 2;
constexpr int turns_of_new = 2;  // until a traced pixel is new no more (glsl/lib/new_pixel.glsl)
constexpr double slow_frame_ms = 1500;

double ms_of(const std::function<void()>& work) {
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    work();
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Before the timed ones: those that make the targets and a history. A pixel's turn comes every 1 / scale^2
// frames.
int frames_before(const Settings& settings) {
    if (settings.new_pixel_samples == 1) return 1;
    return 1 + turns_of_new * static_cast<int>(std::ceil(1 / std::pow(settings.resolution_scale, 2.0f)));
}

Settings exact_settings() {
    Settings settings;
    apply_quality(settings, Quality::Exact);
    return settings;
}

}  // namespace

TradeoffScene::TradeoffScene(const std::string& name, std::uint64_t ticks, const TradeoffOptions& options)
    : options_(options), scene_(load_scene(name, exact_settings())) {
    simulation_ = std::make_unique<Simulation>(scene_, timers_);
    simulation_->step(static_cast<int>(ticks), scene_.settings);
    if (ticks > 0) {
        scene_.cells = simulation_->read_cells();
        simulation_ = std::make_unique<Simulation>(scene_, timers_);
    }
    renderer_ = std::make_unique<Renderer>(scene_, timers_);
    timers_.end_frame();
}

Settings TradeoffScene::settings_of(const Configuration& configuration) const {
    Settings settings = scene_.settings;
    apply(configuration, settings);
    // Refined frames take a time that is not measured here.
    settings.refine_at_rest = false;
    return settings;
}

void TradeoffScene::draw(const Settings& settings, glm::ivec2 size_px) {
    renderer_->render(*simulation_, settings, size_px);
    timers_.end_frame();
}

TradeoffScene::OfRecording& TradeoffScene::references_of(const Recording& recording) {
    const auto found = recordings_.find(recording.name);
    if (found != recordings_.end()) return found->second;
    OfRecording of{.recording = recording, .frames = {}, .references = nullptr};
    // Of a camera and a world at rest every frame has the same reference.
    for (int frame = 0; frame < recording.frames(); frame += options_.frame_stride)
        of.frames.push_back(frame);
    const bool at_rest = !recording.moves_camera() && !recording.moves_world();
    const int pictures = at_rest ? 1 : static_cast<int>(of.frames.size());
    std::string about =
        fmt::format("{}x{} every {} cells {:016x} seed {} {}", options_.error_px.x, options_.error_px.y,
                    options_.frame_stride, hash_of(scene_.cells), scene_.seed, recording_json(recording));
    for (const SettingInfo& info : setting_infos()) {
        // How panels look is in no reference.
        if (info.group == SettingGroup::DISPLAY) continue;
        about += fmt::format(" {}={}", info.name, setting_text(scene_.settings, info));
    }
    std::filesystem::path file;
    if (!options_.folder.empty())
        file = options_.folder / fmt::format("{}-{}.references", scene_.name, recording.name);
    of.references = std::make_unique<References>(file, about, pictures,
                                                 std::size_t{1} * options_.error_px.x * options_.error_px.y);
    return recordings_.emplace(recording.name, std::move(of)).first->second;
}

void TradeoffScene::rest() {
    if (world_at_rest_) return;
    simulation_ = std::make_unique<Simulation>(scene_, timers_);
    renderer_->world_replaced();
    world_at_rest_ = true;
}

void TradeoffScene::play(const OfRecording& of, Settings& settings, bool lead,
                         const std::function<void()>& draw, const std::function<void(int)>& compare) {
    rest();
    world_at_rest_ = !of.recording.moves_world();
    place_camera(of.recording, 0, scene_.settings, settings);
    for (int i = 0; lead && i < of.recording.lead_frames; ++i) draw();
    std::size_t compared = 0;
    EditHistory history;
    for (int frame = 0; frame <= of.frames.back(); ++frame) {
        place_camera(of.recording, frame, scene_.settings, settings);
        play_world(of.recording, frame, scene_.settings, *simulation_, settings, history);
        draw();
        if (compared < of.frames.size() && frame == of.frames[compared]) {
            compare(static_cast<int>(compared));
            ++compared;
        }
    }
}

void TradeoffScene::sample_references(const Recording& recording, int samples,
                                      const std::function<void(int)>& progress) {
    OfRecording& of = references_of(recording);
    References& references = *of.references;
    const int had = references.samples();
    const int more = samples - had;
    if (more <= 0) return;
    Settings settings = scene_.settings;  // of exact mode
    int done = 0;
    play(
        of, settings, false, [] {},
        [&](int index) {
            if (index >= references.frames()) return;
            for (const bool second : {false, true}) {
                renderer_->reset_history();
                renderer_->set_frame_index(halves_from + (second ? half_frames : 0) +
                                           reference_frames * static_cast<std::uint64_t>(index) +
                                           static_cast<std::uint64_t>(had));
                for (int i = 0; i < more; ++i) {
                    draw(settings, options_.error_px);
                    progress(++done);
                }
                references.add(index, second, shown(), more);
            }
        });
    references.added(more);
}

PictureError TradeoffScene::measure_error(const Recording& recording, const Configuration& configuration) {
    OfRecording& of = references_of(recording);
    const References& references = *of.references;
    CHECK(references.samples() > 0);
    Settings settings = settings_of(configuration);
    const std::uint64_t rejected = renderer_->rejected_samples();
    std::vector<Luminance> runs[2];
    double predicted = 0;
    int predictions = 0;
    renderer_->keep_variance(true);
    for (int run = 0; run < 2; ++run) {
        renderer_->reset_history();
        renderer_->set_frame_index(runs_from + run_frames * static_cast<std::uint64_t>(run));
        play(
            of, settings, true, [&] { draw(settings, options_.error_px); },
            [&](int) {
                runs[run].push_back(shown());
                renderer_->measure_error(*simulation_);
                if (const auto estimate = renderer_->estimated_error(true)) {
                    predicted += *estimate;
                    ++predictions;
                }
            });
    }
    renderer_->keep_variance(false);
    PictureError result;
    if (predictions > 0) result.predicted = predicted / predictions;
    const auto frames = static_cast<double>(of.frames.size());
    for (std::size_t i = 0; i < of.frames.size(); ++i) {
        const Reference& reference = references.at(std::min(static_cast<int>(i), references.frames() - 1));
        for (const auto& run : runs) result.error += error_of(run[i], reference) / frames / 2;
        result.bias += bias_of(runs[0][i], runs[1][i], reference) / frames;
    }
    result.floor = references.floor();
    result.reference_samples = 2 * references.samples();
    result.rejected = renderer_->rejected_samples() - rejected;
    return result;
}

std::vector<PictureError> TradeoffScene::measure_exact(const Recording& recording,
                                                       std::span<const int> samples) {
    OfRecording& of = references_of(recording);
    Settings settings = scene_.settings;
    rest();
    place_camera(recording, 0, scene_.settings, settings);
    renderer_->reset_history();
    renderer_->set_frame_index(runs_from + 2 * run_frames);
    std::vector<PictureError> errors;
    int done = 0;
    for (const int wanted : samples) {
        for (; done < wanted; ++done) draw(settings, options_.error_px);
        const Reference& reference = of.references->at(0);
        PictureError& error = errors.emplace_back();
        error.error = error_of(shown(), reference);
        error.floor = floor_of(reference);
        error.reference_samples = 2 * reference.samples;
        renderer_->measure_error(*simulation_);
        error.predicted = renderer_->estimated_error(true).value_or(-1);
    }
    return errors;
}

std::vector<double> TradeoffScene::measure_times(std::span<const Configuration> configurations) {
    rest();
    // New pixels are paid for in flight.
    const Recording flight = load_recording("flying");
    std::vector<std::vector<double>> ms(configurations.size());
    // The first round compiles.
    for (int round = 0; round <= options_.rounds; ++round)
        for (std::size_t c = 0; c < configurations.size(); ++c) {
            const bool slow = !ms[c].empty() && ms[c].back() > slow_frame_ms;
            if (slow && ms[c].size() > 1) continue;
            Settings settings = settings_of(configurations[c]);
            renderer_->reset_history();
            for (int i = 0; i < (round == 0 ? 1 : frames_before(settings)); ++i)
                draw(settings, round == 0 ? options_.error_px : options_.time_px);
            if (round == 0) continue;
            for (int i = 0; i < (slow ? 1 : frames_of_turn); ++i) {
                place_camera(flight, i + 1, scene_.settings, settings);
                ms[c].push_back(ms_of([&] { draw(settings, options_.time_px); }));
            }
        }
    std::vector<double> medians;
    for (std::vector<double>& of_one : ms) {
        std::sort(of_one.begin(), of_one.end());
        medians.push_back(of_one[of_one.size() / 2]);
    }
    return medians;
}

}  // namespace tarn
