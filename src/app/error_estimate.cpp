#include "app/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "shared/trial.h"

namespace tarn {

namespace {

// Odd, so that it meets every place of a picture that is traced at half its size.
int stride_for(glm::ivec2 size_px) {
    const double pixels = static_cast<double>(size_px.x) * size_px.y;
    return static_cast<int>(std::ceil(std::sqrt(pixels / TRIAL_PIXELS))) | 1;
}

}  // namespace

std::optional<double> combined_error(std::optional<double> noise, std::optional<Trial> trial) {
    if (!trial) return noise;
    const double sure = 2 * std::sqrt(trial->variance);
    if (trial->error > sure) return trial->error;
    if (noise) return std::min(*noise, std::max(trial->error, 0.0) + sure);
    return std::nullopt;
}

ErrorEstimate::Targets::Targets(glm::ivec2 size_px)
    : stride(stride_for(size_px)),
      variance({.label = "variance", .format = GL_RGBA32F, .size = {size_px, 0}}),
      radiance({.label = "radiance for its error", .format = GL_RGBA32F, .size = {size_px, 0}}),
      variance_target("variance", {&variance}),
      radiance_target("radiance for its error", {&radiance}) {
    const glm::ivec2 tried_px = (size_px + stride - 1) / stride;
    surface = gl::Texture({.label = "surface of a trial", .format = GL_R32UI, .size = {tried_px, 0}});
    for (int i = 0; i < 2; ++i) {
        samples[i] = gl::Texture({.label = "sample of a trial", .format = GL_RGBA32F, .size = {tried_px, 0}});
        sample_target[i] = gl::Framebuffer("sample of a trial", {&samples[i], &surface});
    }
}

void ErrorEstimate::measure(const Picture& picture, gl::Timers& timers) {
    last(false);
    if (!noise_pass_) noise_pass_.emplace();
    if (!trial_pass_) trial_pass_.emplace();
    if (is_under_way()) return;
    if (!targets_ || targets_->radiance_target.size() != picture.size_px) targets_.emplace(picture.size_px);
    improves_ = picture.improves;
    picture.draw_radiance(targets_->radiance_target);
    noise_.reset();
    if (picture.draw_variance) {
        picture.draw_variance(targets_->variance_target);
        noise_pass_->record({.variance = targets_->variance, .radiance = targets_->radiance}, timers);
    }
    if (!picture.draw_sample) {
        trials_.clear();
        return;
    }
    for (const gl::Framebuffer& target : targets_->sample_target)
        picture.draw_sample(target, targets_->stride);
    trial_pass_->record({.picture = targets_->radiance,
                         .sample_a = targets_->samples[0],
                         .sample_b = targets_->samples[1],
                         .stride = targets_->stride},
                        timers);
}

std::optional<double> ErrorEstimate::last(bool wait) {
    if (is_under_way()) take(wait);
    return answer_;
}

void ErrorEstimate::take(bool wait) {
    if (noise_pass_)
        if (const auto arrived = noise_pass_->take(wait)) {
            noise_.reset();
            if (*arrived >= 0) noise_ = *arrived;
        }
    if (trial_pass_)
        if (const auto arrived = trial_pass_->take(wait)) {
            trials_.push_back(*arrived);
            while (trials_.size() > (improves_ ? 1 : trials_kept)) trials_.pop_front();
        }
    // Half of a new answer is none: the old one stands.
    if (!is_under_way()) answer_ = answer();
}

std::optional<double> ErrorEstimate::answer() const {
    if (trials_.empty()) return combined_error(noise_, std::nullopt);
    const auto n = static_cast<double>(trials_.size());
    Trial mean;
    for (const Trial& trial : trials_) {
        mean.error += trial.error / n;
        mean.variance += trial.variance / n / n;
    }
    return combined_error(noise_, mean);
}

bool ErrorEstimate::is_under_way() const {
    return (noise_pass_ && noise_pass_->pending()) || (trial_pass_ && trial_pass_->pending());
}

void ErrorEstimate::begin_anew() {
    if (noise_pass_) noise_pass_->discard();
    if (trial_pass_) trial_pass_->discard();
    noise_.reset();
    trials_.clear();
}

void ErrorEstimate::forget() {
    begin_anew();
    answer_.reset();
}

}  // namespace tarn
