#include "app/governor.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tarn {

namespace {

// How far what was seen may correct a table made elsewhere; and by one fall, whose load may have changed
// meanwhile.
const double correction_max = std::log(4.0);
const double fall_lesson_max = std::log(1.5);
// Corrections fade by a half in 20,000 frames, lest a lesson of an odd moment holds for good.
constexpr double fading = 0.99996534;
// A move up that had to be taken back within so many frames was a mistake.
constexpr int regret_frames = 240;
// A load that is gone within so many frames was a spike.
constexpr int spike_frames = 60;
constexpr int long_ago = 1 << 20;

}  // namespace

Governor::Governor(std::vector<double> times)
    : as_given_(std::move(times)), correction_(as_given_.size(), 0) {
    CHECK(!as_given_.empty());
}

double Governor::time_of(std::size_t point) const {
    return as_given_[point] * std::exp(correction_[point]);
}

// Of at most the `newest` last ones.
double Governor::median(std::size_t newest) const {
    std::vector<double> last(recent_.end() - static_cast<std::ptrdiff_t>(std::min(newest, recent_.size())),
                             recent_.end());
    const auto middle = last.begin() + static_cast<std::ptrdiff_t>(last.size() / 2);
    std::nth_element(last.begin(), middle, last.end());
    return *middle;
}

void Governor::arrived_at(std::size_t point, bool by_fall) {
    scaled_before_ = recent_.size() < frames_known ? 0 : std::max(0.0, median(frames_urgent) - fixed_ms_);
    point_before_ = point_;
    point_ = point;
    frames_here_ = 0;
    fell_here_ = by_fall;
    recent_.clear();
}

// What the switch did to the time of a frame, once the new one is known.
void Governor::learn() {
    const double scaled = median(frames_urgent) - fixed_ms_;
    if (scaled_before_ > 0 && scaled > 0) {
        const double seen = std::log(scaled / scaled_before_ * time_of(point_before_) / as_given_[point_]);
        const bool load_changed = fell_here_ && std::abs(seen - correction_[point_]) > fall_lesson_max;
        if (!load_changed) correction_[point_] = std::clamp(seen, -correction_max, correction_max);
    }
    scaled_before_ = 0;
}

bool Governor::is_overloaded(double target_ms) const {
    const double least = *std::min_element(recent_.end() - frames_urgent, recent_.end());
    return least > slack_urgent * target_ms ||
           (recent_.size() >= frames_down && median(frames_down) > slack_down * target_ms);
}

// The point to go back to after a fall whose load is gone already; point_ where there is none. Not twice in a
// row: a load that keeps coming is none to come back for.
std::size_t Governor::back_from_spike(double target_ms) {
    if (since_fall_ > spike_frames || since_back_ < regret_frames || since_up_ < regret_frames) return point_;
    std::size_t back = std::max(fell_from_, point_);
    while (back > point_ && expected_ms(back) > aim * target_ms) --back;
    if (back > point_) since_back_ = 0;
    return back;
}

std::size_t Governor::frame(double ms, std::size_t point, double target_ms, double fixed_ms) {
    if (!(ms > 0) || !std::isfinite(ms)) return point;
    point = std::min(point, as_given_.size() - 1);
    if (!started_) point_ = point;
    started_ = true;
    if (point != point_) {
        arrived_at(point, false);
        since_fall_ = long_ago;
    }
    for (int* since : {&since_up_, &since_fall_, &since_back_}) *since = std::min(*since + 1, long_ago);
    for (double& correction : correction_) correction *= fading;
    if (++frames_here_ <= settle_frames) return point;
    recent_.push_back(ms);
    if (recent_.size() > frames_kept) recent_.erase(recent_.begin());
    if (recent_.size() < frames_known) return point;
    known_ms_ = median(frames_down);
    known_point_ = point;
    fixed_ms_ = std::isfinite(fixed_ms) ? std::clamp(fixed_ms, 0.0, known_ms_) : 0;
    if (recent_.size() < frames_urgent) return point;
    if (recent_.size() == frames_urgent) learn();
    if (!(target_ms > 0)) return point;

    if (point > 0 && is_overloaded(target_ms)) {
        known_ms_ = median(frames_urgent);
        std::size_t next = point - 1;
        while (next > 0 && expected_ms(next) > aim * target_ms &&
               fall_max * time_of(next - 1) >= time_of(point))
            --next;
        if (since_up_ < regret_frames) patience_ = std::min(2 * patience_, patience_max);
        if (since_fall_ > spike_frames) {
            fell_from_ = point;
            since_fall_ = 0;
            if (since_up_ >= regret_frames) patience_ = frames_up;
        }
        arrived_at(next, true);
        return next;
    }
    std::size_t next = back_from_spike(target_ms);
    const bool patient = recent_.size() == frames_kept && frames_here_ >= patience_ + settle_frames;
    if (next == point && patient && point + 1 < as_given_.size()) {
        known_ms_ = median(frames_kept);
        if (expected_ms(point + 1) < slack_up * target_ms) {
            since_up_ = 0;
            next = point + 1;
        }
    }
    if (next != point) arrived_at(next, false);
    return next;
}

double Governor::expected_ms(std::size_t point) const {
    if (known_ms_ <= 0) return 0;
    const double fixed = std::min(fixed_ms_, known_ms_);  // another median may know less
    return fixed +
           (known_ms_ - fixed) * time_of(std::min(point, as_given_.size() - 1)) / time_of(known_point_);
}

}  // namespace tarn
