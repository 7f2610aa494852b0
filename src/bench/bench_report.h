// The benchmark's figures as text, CSV and JSON, and two runs side by side. Knows no GL.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/figures.h"

namespace tarn {

struct BenchReport {
    std::vector<std::pair<std::string, std::string>> about;  // machine, driver, versions, arguments
    std::string settings_json;
    std::vector<BenchFigure> figures;
    std::vector<std::string> notes, failures;
};

// Processor, threads, load and memory of this machine, system and compiler.
std::vector<std::pair<std::string, std::string>> about_machine();

std::string figures_text(std::span<const BenchFigure> figures);
std::string bench_csv(std::span<const BenchFigure> figures);  // one row a figure
std::string bench_json(const BenchReport& report);            // every sample

// Figures of bench_json's text; `origin` names it in errors. Throws Error where it is something else.
std::vector<BenchFigure> read_bench_json(const std::string& text, const std::string& origin);

// Ratios of medians, new / old, of the figures that both hold, and whether all samples of one run lie beyond
// those of the other: a busy machine suffices for that. Below them the bars of both.
std::string compare_text(std::span<const BenchFigure> before, std::span<const BenchFigure> now);

}  // namespace tarn
