#include "measure/tradeoff_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"

namespace tarn {

namespace {

constexpr const char* columns[] = {
    "program", "scene", "recording",  "label",     "time_ms",           "time_ratio", "error",
    "bias",    "floor", "near_floor", "predicted", "reference_samples", "rejected",   "settings"};

using Place = std::pair<std::string, std::string>;  // scene, recording

std::vector<Place> places_of(std::span<const TradeoffRow> rows) {
    std::vector<Place> places;
    for (const TradeoffRow& row : rows)
        if (std::find(places.begin(), places.end(), Place(row.scene, row.recording)) == places.end())
            places.emplace_back(row.scene, row.recording);
    return places;
}

std::vector<std::string> parts_of(const std::string& line) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        parts.push_back(line.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

// Errors and times of no sense keep out of logarithms.
double logarithm(double value) {
    return std::log(std::max(value, 1e-30));
}

}  // namespace

std::string tradeoff_csv_head() {
    return fmt::format("{}\n", fmt::join(columns, ","));
}

std::string tradeoff_csv_line(const TradeoffRow& r) {
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.program, r.scene, r.recording,
                       label_of(r.configuration), r.time_ms, r.time_ratio, r.error, r.bias, r.floor,
                       r.near_floor() ? 1 : 0, r.predicted, r.reference_samples, r.rejected,
                       text_of(r.configuration));
}

std::vector<TradeoffRow> read_tradeoff_csv(const std::string& text, const std::string& origin,
                                           const std::string& program, int& others) {
    others = 0;
    std::vector<TradeoffRow> rows;
    if (text.empty()) return rows;
    std::string wanted = program;
    if (wanted.empty()) {
        const std::size_t last_end = text.rfind('\n');
        const std::size_t last = last_end == 0 ? 0 : text.rfind('\n', last_end - 1);
        if (last != std::string::npos) wanted = text.substr(last + 1, text.find(',', last) - last - 1);
    }
    std::size_t begin = text.find('\n');
    const bool known = begin != std::string::npos && text.substr(0, begin + 1) == tradeoff_csv_head();
    if (!known)
        fail("{}: not a table of this program's `tarn tradeoff`; move it away, or run without --resume",
             origin);
    for (++begin; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string::npos) break;  // cut short
        const auto parts = parts_of(text.substr(begin, end - begin));
        begin = end + 1;
        if (parts.size() != std::size(columns) || parts[0] != wanted) {
            ++others;
            continue;
        }
        try {
            rows.push_back({.program = parts[0],
                            .scene = parts[1],
                            .recording = parts[2],
                            .configuration = parse_configuration(parts[13]),
                            .time_ms = std::stod(parts[4]),
                            .time_ratio = std::stod(parts[5]),
                            .error = std::stod(parts[6]),
                            .bias = std::stod(parts[7]),
                            .floor = std::stod(parts[8]),
                            .predicted = std::stod(parts[10]),
                            .reference_samples = std::stoi(parts[11]),
                            .rejected = std::stoull(parts[12])});
        } catch (const std::exception&) {
            ++others;
        }
    }
    return rows;
}

std::vector<Measured> over_all(std::span<const TradeoffRow> rows) {
    struct Sum {
        double time = 0, error = 0;
        std::size_t places = 0;
        bool eligible = true;
    };
    const std::size_t places = places_of(rows).size();
    std::vector<std::pair<Configuration, Sum>> sums;
    for (const TradeoffRow& row : rows) {
        auto found = std::find_if(sums.begin(), sums.end(),
                                  [&](const auto& s) { return s.first == row.configuration; });
        if (found == sums.end()) found = sums.insert(sums.end(), {row.configuration, {}});
        Sum& sum = found->second;
        sum.time += logarithm(row.time_ratio);
        sum.error += logarithm(row.error);
        sum.eligible &= !row.near_floor();
        ++sum.places;
    }
    std::vector<Measured> measured;
    for (const auto& [configuration, sum] : sums) {
        if (sum.places != places) continue;
        const auto n = static_cast<double>(places);
        measured.push_back({configuration, std::exp(sum.time / n), std::exp(sum.error / n), sum.eligible});
    }
    // What was `balanced` when the rows were measured may be another configuration now.
    const Configuration balanced = configuration_of(Quality::Balanced);
    for (const Measured& now : measured) {
        if (now.configuration != balanced) continue;
        const double unit = now.time;
        for (Measured& m : measured) m.time /= unit;
        break;
    }
    return measured;
}

std::vector<Measured> of_place(std::span<const TradeoffRow> rows, const std::string& scene,
                               const std::string& recording) {
    // Batches ran under different loads of the machine: by ratios to `balanced`, whose own time is one of
    // them.
    double unit_ms = 1;
    const Configuration balanced = configuration_of(Quality::Balanced);
    for (const TradeoffRow& row : rows)
        if (row.scene == scene && row.configuration == balanced) unit_ms = row.time_ms / row.time_ratio;
    std::vector<Measured> measured;
    for (const TradeoffRow& row : rows)
        if (row.scene == scene && row.recording == recording)
            measured.push_back({row.configuration, unit_ms * row.time_ratio, row.error, !row.near_floor()});
    return measured;
}

double Curve::error_at(double time) const {
    CHECK(!points.empty());
    if (time <= points.front().time) return points.front().error;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Measured& a = points[i - 1];
        const Measured& b = points[i];
        if (time > b.time) continue;
        const double part = (logarithm(time) - logarithm(a.time)) / (logarithm(b.time) - logarithm(a.time));
        return std::exp(logarithm(a.error) + part * (logarithm(b.error) - logarithm(a.error)));
    }
    const Measured& last = points.back();
    const double noise = std::max(0.0, last.error - bias);
    return std::max(bias, 0.0) + noise * last.time / time;
}

std::optional<double> Curve::time_for(double error) const {
    CHECK(!points.empty());
    if (points.front().error <= error) return points.front().time;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Measured& a = points[i - 1];
        const Measured& b = points[i];
        if (b.error > error) continue;
        const double part =
            (logarithm(error) - logarithm(a.error)) / (logarithm(b.error) - logarithm(a.error));
        return std::exp(logarithm(a.time) + part * (logarithm(b.time) - logarithm(a.time)));
    }
    const Measured& last = points.back();
    if (error <= bias || last.error <= bias) return std::nullopt;
    return last.time * (last.error - bias) / (error - bias);
}

Configuration baseline_with(int samples) {
    Settings settings;
    apply_quality(settings, Quality::Baseline);
    settings.samples_per_pixel = samples;
    return configuration_of(settings);
}

std::vector<TradeoffBar> tradeoff_bars(std::span<const TradeoffRow> rows) {
    std::vector<TradeoffBar> bars;
    const Configuration balanced = configuration_of(Quality::Balanced);
    for (const auto& [scene, recording] : places_of(rows)) {
        const TradeoffRow* mine = nullptr;
        Curve curve;
        for (const TradeoffRow& row : rows) {
            if (row.scene != scene || row.recording != recording) continue;
            if (row.configuration == balanced) mine = &row;
        }
        if (mine == nullptr) continue;
        for (const int samples : baseline_samples)
            for (const TradeoffRow& row : rows) {
                if (row.scene != scene || row.recording != recording) continue;
                if (row.configuration != baseline_with(samples)) continue;
                // Times of both as ratios within their own rounds.
                curve.points.push_back({row.configuration, row.time_ratio, row.error});
                curve.bias = std::max(0.0, row.bias);
            }
        if (curve.points.empty()) continue;
        TradeoffBar bar{.scene = scene,
                        .recording = recording,
                        .balanced_ms = mine->time_ms,
                        .balanced_error = mine->error,
                        .error_bar = recording == "moving-water" ? 5.0 : 10.0,
                        .time_bar = 20,
                        .near_floor = mine->near_floor()};
        bar.baseline_error = curve.error_at(mine->time_ratio);
        bar.at_least = mine->time_ratio < curve.points.front().time;
        bar.error_ratio = bar.baseline_error / mine->error;
        if (const auto time = curve.time_for(mine->error)) {
            bar.baseline_ms = *time / mine->time_ratio * mine->time_ms;
            bar.extrapolated = *time > curve.points.back().time;
        }
        bar.baseline_floor = curve.bias;
        bars.push_back(bar);
    }
    return bars;
}

std::string bars_text(std::span<const TradeoffBar> bars) {
    std::string text = fmt::format("{:<10} {:<13} {:>10} {:>10} {:>14} {:>16} {:>5}  {:<44}\n", "scene",
                                   "recording", "balanced", "relMSE", "baseline's", "times less", "bar",
                                   "baseline for the same error (bar 20)");
    for (const TradeoffBar& b : bars) {
        std::string time;
        if (b.baseline_ms)
            time = fmt::format("{:.1f} times the time{}: {}", *b.baseline_ms / b.balanced_ms,
                               b.extrapolated ? ", extrapolated" : "",
                               *b.baseline_ms >= b.time_bar * b.balanced_ms ? "pass" : "MISS");
        else
            time = fmt::format("never: its floor is {:.3g}", b.baseline_floor);
        text += fmt::format("{:<10} {:<13} {:>7.1f} ms {:>10.3g} {:>14.3g} {:>9}{:>7.2f} {:>5}  {:<44}{}\n",
                            b.scene, b.recording, b.balanced_ms, b.balanced_error, b.baseline_error,
                            b.at_least ? "at least" : "", b.error_ratio,
                            b.error_ratio >= b.error_bar ? "pass" : fmt::format("< {:g}", b.error_bar), time,
                            b.near_floor ? "  (near its floor)" : "");
    }
    return text;
}

std::vector<std::string> beaten_qualities(std::span<const TradeoffRow> rows) {
    std::vector<std::string> lines;
    const auto look = [&](const std::string& where, const std::vector<Measured>& measured) {
        for (const Quality quality : {Quality::Fast, Quality::Balanced, Quality::Quality}) {
            const Configuration configuration = configuration_of(quality);
            const auto mine = std::find_if(measured.begin(), measured.end(), [&](const Measured& m) {
                return m.configuration == configuration;
            });
            if (mine == measured.end()) continue;
            const Measured* best = nullptr;
            for (const Measured& m : measured) {
                if (!m.eligible || m.time * beaten_factor > mine->time ||
                    m.error * beaten_factor > mine->error)
                    continue;
                if (best == nullptr || m.time * m.error < best->time * best->error) best = &m;
            }
            if (best != nullptr)
                lines.push_back(fmt::format("{}: {} is beaten {:.2f} times in time, {:.2f} in error by {}",
                                            where, label_of(configuration), mine->time / best->time,
                                            mine->error / best->error, label_of(best->configuration)));
        }
    };
    look("over all", over_all(rows));
    for (const auto& [scene, recording] : places_of(rows))
        look(fmt::format("{} {}", scene, recording), of_place(rows, scene, recording));
    return lines;
}

std::string front_letter(std::size_t index) {
    return index < 26 ? std::string(1, static_cast<char>('a' + index)) : std::string();
}

std::string tradeoff_text(std::span<const TradeoffRow> rows) {
    const std::vector<Measured> measured = over_all(rows);
    std::string text = fmt::format(
        "Over all scenes and recordings (geometric means; time as a ratio to balanced):\n  {:>8} {:>10}   "
        "{}\n",
        "time", "relMSE", "front, from fast to accurate");
    const auto on_front = pareto_front(measured);
    for (std::size_t i = 0; i < on_front.size(); ++i) {
        const Measured& m = measured[on_front[i]];
        text += fmt::format("{:<1} {:>8.3f} {:>10.4g}   {}\n", front_letter(i), m.time, m.error,
                            label_of(m.configuration));
    }
    text += fmt::format("  {:>8} {:>10}   qualities\n", "time", "relMSE");
    for (const Measured& m : measured)
        for (const Quality q : {Quality::Baseline, Quality::Fast, Quality::Balanced, Quality::Quality})
            if (m.configuration == configuration_of(q))
                text +=
                    fmt::format("  {:>8.3f} {:>10.4g}   {}{}\n", m.time, m.error, label_of(m.configuration),
                                m.eligible ? "" : "  (a row within 3 times its floor)");
    return text;
}

std::string fronts_text(std::span<const TradeoffRow> rows) {
    std::string text;
    for (const auto& [scene, recording] : places_of(rows)) {
        const std::vector<Measured> measured = of_place(rows, scene, recording);
        text += fmt::format("{} {}:\n  {:>9} {:>10}\n", scene, recording, "ms", "relMSE");
        const auto on_front = pareto_front(measured);
        for (std::size_t i = 0; i < on_front.size(); ++i) {
            const Measured& m = measured[on_front[i]];
            text += fmt::format("{:<1} {:>9.1f} {:>10.4g}   {}\n", front_letter(i), m.time, m.error,
                                label_of(m.configuration));
        }
    }
    return text;
}

}  // namespace tarn
