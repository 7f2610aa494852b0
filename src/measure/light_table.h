// What each way of finding light costs and errs by: scenes rendered by several strategies in turn, their
// means, variances and times side by side.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/settings.h"

namespace tarn {

struct LightStrategy {
    const char* name;
    std::vector<const char*> set;  // key=value, over quality exact
};

struct LightScenario {
    const char* name;
    const char* what;
    const char* scene;  // a built-in name, or JSON
    std::vector<LightStrategy> strategies;
};

std::span<const LightScenario> light_scenarios();

// Whether the strategies of a scenario differ in this setting.
bool is_set_by(const LightScenario& scenario, std::string_view key);

struct LightRow {
    std::string scenario, strategy;
    double mean = 0, standard_error = 0;  // luminance over the picture
    double off_by = 0;             // from the first strategy's mean, in standard errors of the difference
    double relative_variance = 0;  // the relMSE of one sample of a pixel (see measure_light)
    double sample_ms = 0;          // of the whole picture, median over the rounds
    double gain = 1;               // relative variance times time of the first strategy over this one's
    std::uint64_t rejected = 0;    // samples that were not finite
};

struct LightOptions {
    glm::ivec2 size_px{96, 54};
    int rounds = 12;               // at least 2; each an independent picture of every strategy, in turn
    int samples = 8;               // of a pixel in a round
    std::vector<std::string> set;  // key=value, over all strategies
};

// The relative variance is mean(variance / (ref^2 + 0.01 mean(ref)^2)) over the pixels, ref the mean picture
// of the last strategy. Needs a current context. `progress` is called with the share done. Throws Error for
// bad assignments.
std::vector<LightRow> measure_light(const LightScenario& scenario, const LightOptions& options,
                                    const std::function<void(double)>& progress);

std::string light_text(std::span<const LightRow> rows);
std::string light_csv(std::span<const LightRow> rows);

}  // namespace tarn
