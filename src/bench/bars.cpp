#include "bench/bars.h"

#include <fmt/format.h>

#include <algorithm>

namespace tarn {

namespace {

struct Bar {
    const char* what;
    FigureKey over, under;  // under.suite "": the bar is on `over` itself
    double at_least, reach_for;
    bool more_is_better;
};

FigureKey rays(const char* scene, const char* kind, const char* who) {
    return {"rays", scene, kind, who};
}

std::vector<Bar> bars() {
    std::vector<Bar> list;
    for (const char* scene : {"terrain-128", "terrain-256", "terrain-512"})
        list.push_back({"primary rays, Tarn / Embree's packets", rays(scene, "primary", "tarn"),
                        rays(scene, "primary", "embree-8"), 0.5, 1, true});
    list.push_back({"diffuse rays, Tarn / Embree's single rays", rays("terrain-128", "diffuse", "tarn"),
                    rays("terrain-128", "diffuse", "embree-1"), 0.8, 1.5, true});
    for (const char* scene : {"terrain-256", "terrain-512"})
        list.push_back({"diffuse rays, Tarn / Embree's single rays", rays(scene, "diffuse", "tarn"),
                        rays(scene, "diffuse", "embree-1"), 0.4, 1, true});
    for (const char* kind : {"all kinds", "primary", "diffuse", "in-water", "shadow"}) {
        list.push_back({"rays, Tarn / voxel by voxel", rays("terrain-256", kind, "tarn"),
                        rays("terrain-256", kind, "voxel"), 5, 8, true});
        list.push_back({"rays, Tarn / voxel by voxel", rays("terrain-512", kind, "tarn"),
                        rays("terrain-512", kind, "voxel"), 10, 20, true});
    }
    // Cost is the inverse of rays a second.
    list.push_back({"cost of a primary ray, 512^3 / 128^3", rays("terrain-128", "primary", "tarn"),
                    rays("terrain-512", "primary", "tarn"), 1.6, 1.2, false});
    const FigureKey lake_rays{"frame", "lake", "primary rays 640x360", "embree-8"};
    list.push_back({"frame, balanced / Embree's primary rays",
                    {"frame", "lake", "frame 640x360", "balanced"},
                    lake_rays,
                    11,
                    6,
                    false});
    list.push_back({"frame, fast / Embree's primary rays",
                    {"frame", "lake", "frame 640x360", "fast"},
                    lake_rays,
                    4,
                    2,
                    false});
    list.push_back({"tick all awake, GPU / CPU on all threads",
                    {"sim", "terrain-512", "tick", "awake"},
                    {"sim", "terrain-512", "tick", "cpu awake"},
                    2.5,
                    1,
                    false});
    list.push_back({"tick, at rest / all awake",
                    {"sim", "terrain-512", "tick", "asleep"},
                    {"sim", "terrain-512", "tick", "awake"},
                    0.005,
                    0.001,
                    false});
    list.push_back({"tick at rest, 512^3 / 64^3",
                    {"sim", "terrain-512", "tick", "asleep"},
                    {"sim", "terrain-512", "tick", "asleep 64^3"},
                    2,
                    1.2,
                    false});
    list.push_back({"stroke of radius 8 / balanced frame",
                    {"edit", "terrain-512", "stroke", "radius 8"},
                    {"edit", "terrain-512", "frame 640x360", "balanced"},
                    0.05,
                    0.01,
                    false});
    list.push_back(
        {"start to first frame, warm, s", {"start", "lake", "first frame", "warm"}, {}, 2, 1, false});
    return list;
}

}  // namespace

std::vector<BarRow> bar_rows(std::span<const BenchFigure> figures) {
    std::vector<BarRow> rows;
    for (const Bar& bar : bars()) {
        const bool of_rays = bar.over.suite == "rays" && bar.over.scene == bar.under.scene;
        BarRow& row = rows.emplace_back(BarRow{
            .what = fmt::format("{} ({}{})", bar.what, of_rays ? bar.over.what + ", " : "", bar.over.scene),
            .value = std::nullopt,
            .at_least = bar.at_least,
            .reach_for = bar.reach_for,
            .more_is_better = bar.more_is_better});
        const BenchFigure* over = find_figure(figures, bar.over);
        if (over == nullptr) continue;
        if (bar.under.suite.empty()) {
            row.value = statistics_of(over->samples).median;
        } else if (const BenchFigure* under = find_figure(figures, bar.under)) {
            row.value = ratio_of(*over, *under);
        }
    }
    return rows;
}

std::string bars_text(std::span<const BarRow> rows) {
    std::string text =
        fmt::format("{:<66} {:>9} {:>10} {:>10}  {}\n", "bar", "here", "at least", "reach for", "verdict");
    for (const BarRow& row : rows) {
        const char* sign = row.more_is_better ? ">=" : "<=";
        const char* verdict = row.reached() ? "reached" : row.met() ? "met" : "missed";
        text +=
            fmt::format("{:<66} {:>9} {:>10} {:>10}  {}\n", row.what,
                        row.value ? fmt::format("{:.4g}", *row.value) : std::string("-"),
                        fmt::format("{} {:g}", sign, row.at_least),
                        fmt::format("{} {:g}", sign, row.reach_for), row.value ? verdict : "not measured");
    }
    return text;
}

}  // namespace tarn
