#include "app/governor.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tarn {

namespace {

// How far what was seen may correct a table made elsewhere.
constexpr double correction_max = 4;
// A move up that had to be taken back within so many frames was a mistake.
constexpr int regret_frames = 240;

}  // namespace

Governor::Governor(std::vector<double> times) : times_(std::move(times)), as_given_(times_) {
    CHECK(!times_.empty());
}

// Of at most the `newest` last ones.
double Governor::median(std::size_t newest) const {
    std::vector<double> last(recent_.end() - static_cast<std::ptrdiff_t>(std::min(newest, recent_.size())),
                             recent_.end());
    const auto middle = last.begin() + static_cast<std::ptrdiff_t>(last.size() / 2);
    std::nth_element(last.begin(), middle, last.end());
    return *middle;
}

void Governor::arrived_at(std::size_t point) {
    ms_before_ = recent_.empty() ? 0 : median(frames_down);
    point_before_ = point_;
    point_ = point;
    frames_here_ = 0;
    recent_.clear();
}

// What the switch did to the time of a frame, once the new one is known.
void Governor::learn() {
    if (ms_before_ <= 0 || recent_.size() != frames_down) return;
    const double seen = times_[point_before_] * median(frames_down) / ms_before_;
    times_[point_] = std::clamp(seen, as_given_[point_] / correction_max, as_given_[point_] * correction_max);
    ms_before_ = 0;
}

std::size_t Governor::frame(double ms, std::size_t point, double target_ms) {
    if (!(ms > 0) || !std::isfinite(ms)) return point;
    point = std::min(point, times_.size() - 1);
    if (!started_) point_ = point;
    started_ = true;
    if (point != point_) arrived_at(point);
    since_up_ = std::min(since_up_ + 1, 1 << 20);
    if (++frames_here_ <= settle_frames) return point;
    recent_.push_back(ms);
    if (recent_.size() > frames_kept) recent_.erase(recent_.begin());
    if (recent_.size() < frames_down) return point;
    learn();
    known_ms_ = median(frames_down);
    known_point_ = point;
    if (!(target_ms > 0)) return point;

    const auto expected = [&](std::size_t at) { return known_ms_ * times_[at] / times_[point]; };
    if (known_ms_ > slack_down * target_ms && point > 0) {
        std::size_t next = point - 1;
        while (next > 0 && expected(next) > aim * target_ms) --next;
        patience_ = since_up_ < regret_frames ? std::min(2 * patience_, patience_max) : frames_up;
        arrived_at(next);
        return next;
    }
    const bool patient = recent_.size() == frames_kept && frames_here_ >= patience_ + settle_frames;
    if (patient && point + 1 < times_.size() &&
        median(frames_kept) * times_[point + 1] / times_[point] < slack_up * target_ms) {
        since_up_ = 0;
        arrived_at(point + 1);
        return point + 1;
    }
    return point;
}

double Governor::expected_ms(std::size_t point) const {
    if (known_ms_ <= 0) return 0;
    return known_ms_ * times_[std::min(point, times_.size() - 1)] / times_[known_point_];
}

}  // namespace tarn
