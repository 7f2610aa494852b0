// The rows of a measured trade: their CSV, what they say of each configuration over all scenes, the bars, and
// the text printed of them. Measures nothing.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/front.h"
#include "measure/tradeoff_space.h"

namespace tarn {

// A row within this factor of its reference's own error chooses nothing.
constexpr double floor_factor = 3;
// What beats another by less than this in time or in error may do so by chance.
constexpr double beaten_factor = 1.1;

struct TradeoffRow {
    std::string program;  // hash of the program and of what was asked of it: rows of another are not mixed in
    std::string scene, recording;
    Configuration configuration;
    double time_ms = 0;                     // of a frame, beside the others of its batch
    double time_ratio = 0;                  // to `balanced` in the same rounds
    double error = 0, bias = 0, floor = 0;  // relMSE; bias: its part that more samples would not lessen
    double predicted = -1;                  // Renderer::estimated_error(), mean over the frames; -1: none
    int reference_samples = 0;
    std::uint64_t rejected = 0;

    bool near_floor() const { return error < floor_factor * floor; }
};

std::string tradeoff_csv_head();
std::string tradeoff_csv_line(const TradeoffRow& row);
// Rows of `program` alone, of the last row's program where it is empty; a line cut short, as by an
// interrupted run, is left out. `others`: rows of other programs. Throws Error naming `origin` where it is no
// such file.
std::vector<TradeoffRow> read_tradeoff_csv(const std::string& text, const std::string& origin,
                                           const std::string& program, int& others);

// Over all scenes and recordings: geometric means of time ratio and error. Only configurations with a row in
// each place that the first one has; not eligible where a row is near its floor. By order of first
// appearance.
std::vector<Measured> over_all(std::span<const TradeoffRow> rows);
// Of one scene and recording; time in ms.
std::vector<Measured> of_place(std::span<const TradeoffRow> rows, const std::string& scene,
                               const std::string& recording);

// A curve of one method by its samples, from least time to most: what it has at another time or error.
struct Curve {
    std::vector<Measured> points;
    double bias = 0;  // of the last
    // On straight lines between the points, both logarithmic; before the first the first counts, after the
    // last the noise falls as one over time and the bias stays.
    double error_at(double time) const;
    // Nothing where even endless time would not reach it.
    std::optional<double> time_for(double error) const;
};

struct TradeoffBar {
    std::string scene, recording;
    double balanced_ms = 0, balanced_error = 0;
    double baseline_error = 0;  // in the same time
    double error_ratio = 0, error_bar = 0;
    bool at_least = false;                   // baseline is slower still: the ratio is a lower bound
    std::optional<double> baseline_ms = {};  // for the same error; nothing: never
    bool extrapolated = false;               // beyond the samples measured
    double baseline_floor = 0;               // the least error it can have, its bias
    double time_bar = 0;
    bool near_floor = false;
};
std::vector<TradeoffBar> tradeoff_bars(std::span<const TradeoffRow> rows);

// Qualities that another measured point beats by more than a tenth in both; a line each.
std::vector<std::string> beaten_qualities(std::span<const TradeoffRow> rows);

// The name of a front's point in charts and tables: a to z, then none.
std::string front_letter(std::size_t index);
std::string tradeoff_text(std::span<const TradeoffRow> rows);  // the front over all, the qualities
std::string fronts_text(std::span<const TradeoffRow> rows);    // that of each scene and recording
std::string bars_text(std::span<const TradeoffBar> bars);

// The front over all scenes for the slider: at most `points_max` points, the ends and the qualities that
// nothing beats by beaten_factor first, then those farthest from their neighbours in time. A quality takes
// the place of front points of about its time.
std::vector<FrontPoint> front_points(std::span<const TradeoffRow> rows, int points_max);

// `baseline` with so many samples.
Configuration baseline_with(int samples);
constexpr int baseline_samples[] = {1, 4, 16};

}  // namespace tarn
