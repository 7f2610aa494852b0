#include "app/error_estimate.h"

namespace tarn {

ErrorEstimate::Targets::Targets(glm::ivec2 size_px)
    : variance({.label = "variance", .format = GL_RGBA32F, .size = {size_px, 0}}),
      radiance({.label = "radiance for its error", .format = GL_RGBA32F, .size = {size_px, 0}}),
      variance_target("variance", {&variance}),
      radiance_target("radiance for its error", {&radiance}) {}

void ErrorEstimate::measure(glm::ivec2 size_px, const Draw& draw_variance, const Draw& draw_radiance,
                            gl::Timers& timers) {
    last(false);
    if (!pass_) pass_.emplace();
    if (pass_->pending()) return;
    if (!targets_ || targets_->variance_target.size() != size_px) targets_.emplace(size_px);
    draw_variance(targets_->variance_target);
    draw_radiance(targets_->radiance_target);
    pass_->record({.variance = targets_->variance, .radiance = targets_->radiance}, timers);
}

std::optional<double> ErrorEstimate::last(bool wait) {
    if (pass_)
        if (const auto arrived = pass_->take(wait)) {
            last_.reset();
            if (*arrived >= 0) last_ = *arrived;
        }
    return last_;
}

}  // namespace tarn
