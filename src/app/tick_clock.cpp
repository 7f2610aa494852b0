#include "app/tick_clock.h"

#include <algorithm>
#include <cmath>

namespace tarn {

int TickClock::ticks_for(double dt_s, double ticks_per_second) {
    if (paused_) {
        owed_ticks_ = 0;
        const int n = step_once_ ? 1 : 0;
        step_once_ = false;
        return n;
    }
    step_once_ = false;
    // Comparisons that a NaN fails.
    const double dt = dt_s > 0 ? std::min(dt_s, frame_dt_max_s) : 0;
    const double rate = ticks_per_second > 0 ? std::min(ticks_per_second, 1e6) : 0;
    owed_ticks_ += dt * rate * speed_;
    int most = ticks_max;
    if (tick_cost_ms_ > 0)
        most = static_cast<int>(std::clamp(budget_ms / tick_cost_ms_, 1.0, static_cast<double>(ticks_max)));
    const int n = static_cast<int>(std::min(std::floor(owed_ticks_), static_cast<double>(most)));
    owed_ticks_ -= n;
    if (owed_ticks_ >= 1) owed_ticks_ = 0;
    return n;
}

void TickClock::set_tick_cost_ms(double ms) {
    tick_cost_ms_ = ms > 0 ? ms : 0;
}

void TickClock::single_step() {
    paused_ = true;
    step_once_ = true;
}

void TickClock::faster() {
    speed_ = std::min(speed_ * 2, speed_max);
}

void TickClock::slower() {
    speed_ = std::max(speed_ / 2, 1 / speed_max);
}

}  // namespace tarn
