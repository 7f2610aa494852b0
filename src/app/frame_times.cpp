#include "app/frame_times.h"

#include <algorithm>
#include <vector>

namespace tarn {

void FrameTimes::add_frame(long frame, double ms) {
    frames_.push_back({frame, ms});
    if (frames_.size() > frames_kept) frames_.pop_front();
}

void FrameTimes::add_picture(long frame, double ms) {
    while (!frames_.empty() && frames_.front().frame < frame) frames_.pop_front();
    if (frames_.empty() || frames_.front().frame != frame) return;
    fixed_ms_.push_back(std::max(0.0, frames_.front().ms - ms));
    frames_.pop_front();
    if (fixed_ms_.size() > frames_fixed) fixed_ms_.pop_front();
}

double FrameTimes::fixed_ms() const {
    if (fixed_ms_.empty()) return 0;
    std::vector<double> last(fixed_ms_.begin(), fixed_ms_.end());
    const auto middle = last.begin() + static_cast<std::ptrdiff_t>(last.size() / 2);
    std::nth_element(last.begin(), middle, last.end());
    return *middle;
}

}  // namespace tarn
