// Turns wall time into simulation ticks: pause, single steps, faster and slower, and a cap so that a slow
// world delays itself and never the player's input. Owns no time source and runs nothing.
#pragma once

namespace tarn {

class TickClock {
  public:
    static constexpr int ticks_max = 8;             // in one frame
    static constexpr double budget_ms = 30;         // of ticks in one frame, but one tick always fits
    static constexpr double speed_max = 16;         // and 1 / speed_max
    static constexpr double frame_dt_max_s = 0.25;  // longer gaps (a stall, a dragged window) count as this

    // Ticks to run in a frame that began `dt_s` after the last. Time that the caps leave over is dropped, not
    // owed. A dt that is not positive (or no number) gives no time.
    int ticks_for(double dt_s, double ticks_per_second);

    // What a tick costs now, as measured; 0 or no number: unknown.
    void set_tick_cost_ms(double ms);

    bool paused() const { return paused_; }
    void set_paused(bool paused) { paused_ = paused; }
    void toggle_paused() { paused_ = !paused_; }
    // Pauses; the next frame runs one tick.
    void single_step();

    // Factor on ticks per second: a power of two.
    double speed() const { return speed_; }
    void faster();
    void slower();
    void reset_speed() { speed_ = 1; }

  private:
    bool paused_ = false;
    bool step_once_ = false;
    double speed_ = 1;
    double tick_cost_ms_ = 0;
    double owed_ticks_ = 0;  // [0, 1) between frames
};

}  // namespace tarn
