#include "cli/tradeoff_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "cli/names.h"
#include "cli/progress.h"
#include "core/assets.h"
#include "core/error.h"
#include "core/files.h"
#include "gl/context.h"
#include "measure/estimate_table.h"
#include "measure/tradeoff_plot.h"
#include "measure/tradeoff_scene.h"
#include "measure/tradeoff_table.h"
#include "measure/water_trade.h"
#include "platform/platform.h"

namespace tarn {

namespace {

namespace fs = std::filesystem;

struct SceneChoice {
    const char* name;
    std::uint64_t ticks;  // until what moves in it moves
};
constexpr SceneChoice scene_choices[] = {{"lake", 0}, {"waterfall", 200}, {"gallery", 0}, {"cave", 0}};

// Timed beside one `balanced` in turn.
constexpr std::size_t batch_size = 8;
constexpr int chart_scale = 2;
constexpr int front_points_max = 12;
constexpr glm::ivec2 size_min_px{32, 16};

std::uint64_t hash_of_text(std::string_view text, std::uint64_t hash) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return hash;
}

glm::ivec2 time_size(const Arguments& arguments) {
    return arguments.size_px == glm::ivec2(0) ? TradeoffOptions().time_px : arguments.size_px;
}

// Of all that a row follows from besides its configuration: this program, its shaders, the driver, the
// options.
std::string program_hash(const TradeoffOptions& options) {
    std::uint64_t hash = hash_of_text(read_text_file("/proc/self/exe"), 0xcbf29ce484222325ull);
    for (const std::string& path : list_assets("")) hash = hash_of_text(read_asset(path), hash);
    const gl::DriverInfo driver = gl::driver_info();
    hash = hash_of_text(driver.renderer + driver.version, hash);
    hash = hash_of_text(fmt::format("{} {} {}x{}", options.frame_stride, options.rounds, options.time_px.x,
                                    options.time_px.y),
                        hash);
    return fmt::format("{:016x}", hash);
}

class LightTrade {
  public:
    LightTrade(const Arguments& arguments, const std::vector<std::string>& scenes);
    void run();
    const std::vector<TradeoffRow>& rows() const { return rows_; }
    // Of exact mode, at several numbers of samples.
    std::vector<EstimateRow> estimates();

  private:
    void prepare_references();
    std::vector<Measured> measure(std::span<const Configuration> configurations);
    void measure_batch(TradeoffScene& scene, std::span<const Configuration> batch);
    const TradeoffRow* row_of(const std::string& scene, const std::string& recording,
                              const Configuration& configuration) const;
    void keep(const TradeoffRow& row);

    const Arguments& arguments_;
    TradeoffOptions options_;
    fs::path csv_;
    std::string program_;
    std::vector<Recording> recordings_;
    std::vector<std::unique_ptr<TradeoffScene>> scenes_;
    std::vector<TradeoffRow> rows_;
    std::unique_ptr<Progress> progress_;
    std::uint64_t done_ = 0;
};

LightTrade::LightTrade(const Arguments& arguments, const std::vector<std::string>& scenes)
    : arguments_(arguments) {
    options_.time_px = time_size(arguments);
    options_.error_px = glm::max(options_.time_px / 4, 1);
    if (arguments.quick) options_.frame_stride = 4;
    if (arguments.quick) options_.rounds = 3;
    if (!arguments.out.empty()) {
        options_.folder = fs::path(arguments.out) / "references";
        make_folder(options_.folder.string(), {});
        csv_ = fs::path(arguments.out) / "tradeoff.csv";
    }
    program_ = program_hash(options_);
    if (!csv_.empty() && arguments.resume && fs::exists(csv_)) {
        int others = 0;
        rows_ = read_tradeoff_csv(read_text_file(csv_), csv_.string(), program_, others);
        fmt::print("{}: {} rows go on, {} of another program are dropped\n", csv_.string(), rows_.size(),
                   others);
    }
    if (!csv_.empty()) {
        std::string text = tradeoff_csv_head();
        for (const TradeoffRow& row : rows_) text += tradeoff_csv_line(row);
        write_file(csv_, text);
    }
    for (const char* name : {"still", "flying", "moving-water"}) recordings_.push_back(load_recording(name));
    for (const SceneChoice& choice : scene_choices)
        if (std::find(scenes.begin(), scenes.end(), choice.name) != scenes.end())
            scenes_.push_back(std::make_unique<TradeoffScene>(choice.name, choice.ticks, options_));
}

void LightTrade::prepare_references() {
    // Doubled until the floor is a tenth of the least error that a quality has.
    constexpr int samples_first = 32;
    constexpr double floor_wanted = 0.1;
    const Configuration best = configuration_of(Quality::Quality);
    for (const auto& scene : scenes_)
        for (const Recording& recording : recordings_) {
            PictureError error;
            for (int samples = samples_first;; samples *= 2) {
                samples = std::min(samples, arguments_.reference_samples / 2);
                const int had = scene->references(recording).samples();
                const int pictures = scene->references(recording).frames();
                Progress progress(fmt::format("references: {} {}", scene->name(), recording.name),
                                  static_cast<std::uint64_t>(std::max(0, samples - had)) * 2 * pictures);
                scene->sample_references(recording, samples,
                                         [&](int done) { progress.show(static_cast<std::uint64_t>(done)); });
                error = scene->measure_error(recording, best);
                if (error.floor <= floor_wanted * error.error) break;
                if (2 * scene->references(recording).samples() >= arguments_.reference_samples) break;
            }
            fmt::print("{:<10} {:<13} reference: {} samples, relMSE {:.3g} ({:.2f} of that of `quality`)\n",
                       scene->name(), recording.name, error.reference_samples, error.floor,
                       error.floor / error.error);
            std::fflush(stdout);
        }
}

const TradeoffRow* LightTrade::row_of(const std::string& scene, const std::string& recording,
                                      const Configuration& configuration) const {
    for (const TradeoffRow& row : rows_)
        if (row.scene == scene && row.recording == recording && row.configuration == configuration)
            return &row;
    return nullptr;
}

void LightTrade::keep(const TradeoffRow& row) {
    rows_.push_back(row);
    if (csv_.empty()) return;
    std::ofstream file(csv_, std::ios::app);
    file << tradeoff_csv_line(row);
    if (!file.flush()) fail("{}: cannot write: the disk may be full", csv_.string());
}

void LightTrade::measure_batch(TradeoffScene& scene, std::span<const Configuration> batch) {
    std::vector<Configuration> missing;
    for (const Configuration& c : batch)
        if (std::any_of(recordings_.begin(), recordings_.end(), [&](const Recording& recording) {
                return row_of(scene.name(), recording.name, c) == nullptr;
            }))
            missing.push_back(c);
    if (missing.empty()) return;
    const Configuration balanced = configuration_of(Quality::Balanced);
    std::vector<Configuration> timed = missing;
    timed.insert(timed.begin(), balanced);
    const std::vector<double> ms = scene.measure_times(timed);
    for (std::size_t i = 0; i < missing.size(); ++i)
        for (const Recording& recording : recordings_) {
            if (row_of(scene.name(), recording.name, missing[i]) == nullptr) {
                const PictureError error = scene.measure_error(recording, missing[i]);
                keep({.program = program_,
                      .scene = scene.name(),
                      .recording = recording.name,
                      .configuration = missing[i],
                      .time_ms = ms[i + 1],
                      .time_ratio = missing[i] == balanced ? 1 : ms[i + 1] / ms[0],
                      .error = error.error,
                      .bias = error.bias,
                      .floor = error.floor,
                      .predicted = error.predicted,
                      .reference_samples = error.reference_samples,
                      .rejected = error.rejected});
            }
            progress_->show(++done_);
        }
}

std::vector<Measured> LightTrade::measure(std::span<const Configuration> configurations) {
    for (std::size_t begin = 0; begin < configurations.size(); begin += batch_size) {
        const auto batch = configurations.subspan(begin, std::min(batch_size, configurations.size() - begin));
        for (const auto& scene : scenes_) measure_batch(*scene, batch);
    }
    std::vector<Measured> result;
    for (const Measured& m : over_all(rows_))
        if (std::find(configurations.begin(), configurations.end(), m.configuration) != configurations.end())
            result.push_back(m);
    return result;
}

void LightTrade::run() {
    prepare_references();
    std::vector<Configuration> baselines;
    for (const int samples : baseline_samples)
        if (!arguments_.quick || samples <= 4) baselines.push_back(baseline_with(samples));
    progress_ =
        std::make_unique<Progress>("configurations", static_cast<std::uint64_t>(arguments_.configurations) *
                                                         scenes_.size() * recordings_.size());
    Settings full;
    apply_quality(full, Quality::Balanced);
    full.resolution_scale = 1;
    const std::vector<Configuration> starts = {configuration_of(Quality::Balanced),
                                               configuration_of(Quality::Fast),
                                               configuration_of(Quality::Quality), configuration_of(full)};
    // An interrupted run knows the qualities at least; baselines take longest.
    if (arguments_.configurations >= static_cast<int>(starts.size() + baselines.size())) measure(starts);
    measure(baselines);
    CoordinateSearch search(starts, arguments_.configurations - static_cast<int>(baselines.size()));
    for (auto batch = search.next(); !batch.empty(); batch = search.next()) search.report(measure(batch));
    progress_.reset();
}

std::vector<EstimateRow> LightTrade::estimates() {
    constexpr int samples[] = {2, 4, 8, 16, 32, 64};
    std::vector<EstimateRow> rows;
    for (const auto& scene : scenes_) {
        const auto errors = scene->measure_exact(recordings_.front(), samples);
        for (std::size_t i = 0; i < errors.size(); ++i)
            rows.push_back({.scene = scene->name(),
                            .label = fmt::format("exact {}", samples[i]),
                            .samples = samples[i],
                            .predicted = errors[i].predicted,
                            .error = errors[i].error,
                            .floor = errors[i].floor});
    }
    return rows;
}

void write_drawing(const fs::path& folder, const std::string& name, const Drawing& drawing) {
    write_file(folder / (name + ".svg"), drawing.svg());
    write_png(folder / (name + ".png"), drawing.image(chart_scale));
}

void write_charts(const fs::path& folder, std::span<const TradeoffRow> rows, const std::string& about) {
    for (const SceneChoice& choice : scene_choices)
        if (std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.scene == choice.name; }))
            write_drawing(folder, fmt::format("tradeoff-{}", choice.name),
                          draw_scene(rows, choice.name, about));
    write_drawing(folder, "tradeoff", draw_over_all(rows, about));
    write_file(folder / "tradeoff.txt",
               tradeoff_text(rows) + "\n" + bars_text(tradeoff_bars(rows)) + "\n" + fronts_text(rows));
}

}  // namespace

std::vector<std::string> tradeoff_scenes() {
    std::vector<std::string> names;
    for (const SceneChoice& choice : scene_choices) names.emplace_back(choice.name);
    return names;
}

namespace {

void report(const Arguments& arguments, std::span<const TradeoffRow> rows, const std::string& about) {
    fmt::print("\n{}\n{}\n", tradeoff_text(rows), bars_text(tradeoff_bars(rows)));
    for (const std::string& line : beaten_qualities(rows)) fmt::print("{}\n", line);
    if (!arguments.out.empty()) write_charts(arguments.out, rows, about);
    if (arguments.write_front.empty()) return;
    const auto points = front_points(rows, front_points_max);
    if (points.empty()) fail("--write-front: no configuration is eligible; sample the references longer");
    write_file(arguments.write_front, front_json(points, fmt::format("tarn tradeoff, {}", about)));
    fmt::print("{}: {} points\n", arguments.write_front, points.size());
}

int report_again(const Arguments& arguments) {
    const fs::path csv = fs::path(arguments.out) / "tradeoff.csv";
    int others = 0;
    const auto rows = read_tradeoff_csv(read_text_file(csv), csv.string(), "", others);
    if (rows.empty()) fail("{}: no rows", csv.string());
    report(arguments, rows, "as measured before");
    return 0;
}

}  // namespace

namespace {

bool run_light(const Arguments& arguments, const std::vector<std::string>& scenes) {
    LightTrade trade(arguments, scenes);
    trade.run();
    const auto& rows = trade.rows();
    std::vector<EstimateRow> estimates = trade.estimates();
    for (const EstimateRow& row : estimate_rows(rows)) estimates.push_back(row);
    report(arguments, rows, gl::driver_info().renderer);
    fmt::print("\n{}", estimate_text(estimates));
    if (!arguments.out.empty()) {
        write_file(fs::path(arguments.out) / "estimate.csv", estimate_csv(estimates));
        write_drawing(arguments.out, "estimate", draw_estimates(estimates));
    }
    return std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.rejected == 0; });
}

void run_water(const Arguments& arguments) {
    std::vector<WaterTradeRow> rows;
    {
        StepProgress progress;
        rows = measure_water_trade(arguments.quick, [&](const std::string& what) { progress.show(what); });
    }
    fmt::print("\n{}", water_trade_text(rows));
    if (arguments.out.empty()) return;
    write_file(fs::path(arguments.out) / "water-trade.csv", water_trade_csv(rows));
    write_drawing(arguments.out, "water-trade", draw_water_trade(rows));
}

}  // namespace

const std::vector<std::string>& tradeoff_parts() {
    static const std::vector<std::string> parts = {"light", "water"};
    return parts;
}

int run_tradeoff_command(const Arguments& arguments) {
    const auto parts = names_of("--part", arguments.suites, tradeoff_parts());
    std::string scenes = arguments.scenarios;
    if (scenes.empty() && arguments.quick) scenes = "lake";
    const auto names = names_of("--scene", scenes, tradeoff_scenes());
    if (arguments.resume && arguments.out.empty()) fail("--resume: of the rows in a folder; give --out too");
    if (arguments.report && arguments.out.empty()) fail("--report: of the rows in a folder; give --out too");
    const glm::ivec2 size = time_size(arguments);
    if (size.x < size_min_px.x || size.y < size_min_px.y)
        fail(
            "--size: {}x{}: errors are of a quarter of it each way, and mean nothing of so few pixels; at "
            "least {}x{}",
            size.x, size.y, size_min_px.x, size_min_px.y);
    if (!arguments.write_front.empty()) check_writable(arguments.write_front);
    if (arguments.report) return report_again(arguments);
    if (!arguments.out.empty()) make_folder(arguments.out, {"tradeoff.svg"});
    const auto platform = make_headless({1, 1}, 0);
    fmt::print("rendered by {}; times at {}x{}, errors at {}x{}\n", gl::driver_info().renderer, size.x,
               size.y, std::max(size.x / 4, 1), std::max(size.y / 4, 1));
    std::fflush(stdout);

    const auto asked = [&](const char* part) {
        return std::find(parts.begin(), parts.end(), part) != parts.end();
    };
    const bool good = !asked("light") || run_light(arguments, names);
    if (asked("water")) run_water(arguments);
    return good ? 0 : 1;
}

}  // namespace tarn
