// The tick clock: what it makes of odd times, and that it never owes the player a frame.
#include "app/tick_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tarn {
namespace {

int run(TickClock& clock, int frames, double dt_s, double ticks_per_second) {
    int ticks = 0;
    for (int i = 0; i < frames; ++i) ticks += clock.ticks_for(dt_s, ticks_per_second);
    return ticks;
}

TEST(TickClock, keeps_the_rate_whatever_the_frame_rate) {
    for (const double frames_per_s : {7.0, 30.0, 59.94, 144.0, 1000.0}) {
        TickClock clock;
        const int frames = static_cast<int>(frames_per_s * 20);
        EXPECT_NEAR(run(clock, frames, 1 / frames_per_s, 30), frames / frames_per_s * 30, 1.01)
            << frames_per_s;
    }
}

TEST(TickClock, gives_no_ticks_for_no_time) {
    TickClock clock;
    EXPECT_EQ(run(clock, 100, 0, 1000), 0);
    EXPECT_EQ(run(clock, 100, -1, 1000), 0);
    EXPECT_EQ(run(clock, 100, std::numeric_limits<double>::quiet_NaN(), 1000), 0);
    EXPECT_EQ(run(clock, 100, 0.1, std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(run(clock, 1, 1, 8), 2) << "odd times left nothing behind; a second counts as a quarter";
}

TEST(TickClock, caps_long_gaps_and_owes_nothing_after) {
    for (const double gap_s : {10.0, 1e300, std::numeric_limits<double>::infinity()}) {
        TickClock clock;
        EXPECT_EQ(clock.ticks_for(gap_s, 1000), TickClock::ticks_max);
        EXPECT_LE(clock.ticks_for(0.001, 30), 1);
        EXPECT_EQ(clock.ticks_for(0, 30), 0);
    }
    TickClock clock;
    EXPECT_EQ(clock.ticks_for(10, std::numeric_limits<double>::infinity()), TickClock::ticks_max);
}

TEST(TickClock, slow_ticks_fill_their_budget_but_one_always_runs) {
    TickClock clock;
    clock.set_tick_cost_ms(TickClock::budget_ms / 3.5);
    EXPECT_EQ(clock.ticks_for(0.2, 1000), 3);
    clock.set_tick_cost_ms(10 * TickClock::budget_ms);
    EXPECT_EQ(clock.ticks_for(0.2, 1000), 1);
    EXPECT_EQ(clock.ticks_for(0.2, 1000), 1);
    clock.set_tick_cost_ms(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(clock.ticks_for(0.2, 1000), TickClock::ticks_max);
    clock.set_tick_cost_ms(std::numeric_limits<double>::infinity());
    EXPECT_EQ(clock.ticks_for(0.2, 1000), 1);
}

TEST(TickClock, pauses_and_steps_once) {
    TickClock clock;
    clock.set_paused(true);
    EXPECT_EQ(run(clock, 10, 0.1, 1000), 0);
    clock.single_step();
    EXPECT_EQ(run(clock, 10, 0.1, 1000), 1);
    EXPECT_EQ(clock.ticks_for(0, 30) + clock.ticks_for(std::nan(""), 30), 0);
    clock.toggle_paused();
    EXPECT_EQ(clock.ticks_for(0.001, 30), 0) << "a pause owes nothing";
    clock.single_step();
    EXPECT_TRUE(clock.paused());
    EXPECT_EQ(clock.ticks_for(0.5, 30), 1);
}

TEST(TickClock, runs_faster_and_slower_within_limits) {
    TickClock clock;
    clock.faster();
    EXPECT_NEAR(run(clock, 1000, 0.01, 30), 600, 1);
    for (int i = 0; i < 20; ++i) clock.faster();
    EXPECT_EQ(clock.speed(), TickClock::speed_max);
    for (int i = 0; i < 40; ++i) clock.slower();
    EXPECT_EQ(clock.speed(), 1 / TickClock::speed_max);
    EXPECT_NEAR(run(clock, 1600, 0.01, 30), 30, 1);
    clock.reset_speed();
    EXPECT_EQ(clock.speed(), 1);
}

}  // namespace
}  // namespace tarn
