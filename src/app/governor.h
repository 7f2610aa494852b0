// Holds a frame time by moving along a list of points from fast to slow. Knows no clock and no settings: it
// is told what frames took and says at which point the next ones should be made.
#pragma once
#include <cstddef>
#include <vector>

namespace tarn {

class Governor {
  public:
    // `times`: of the picture at each point, in any unit; growing.
    explicit Governor(std::vector<double> times);

    // A frame took `ms` at `point`, whoever chose it; `fixed_ms` of it is the same at every point (ticks,
    // panels). Returns the point for the next one; `point` itself where target_ms is 0: then it only learns
    // what to expect. A time that is not positive (or no number) is no frame.
    std::size_t frame(double ms, std::size_t point, double target_ms, double fixed_ms = 0);

    // What a frame would take at a point, from the last frames; 0: not known yet.
    double expected_ms(std::size_t point) const;

    // Frames count once they are past the switch. Down: when the median of nine is above the target by
    // `slack_down`, or each of the last five by `slack_urgent`; never by more than a factor of `fall_max` at
    // once, for the load may be gone by the next look; if so, straight back. Up: by one point, where that is
    // expected below the target by `slack_up`, after a patience that doubles whenever it had to come back.
    static constexpr int settle_frames = 4;  // after a switch: targets and programs are made
    static constexpr int frames_known = 3, frames_urgent = 5, frames_down = 9, frames_up = 30,
                         frames_kept = 30;
    static constexpr double slack_down = 1.1, slack_urgent = 1.25, slack_up = 0.85, aim = 0.95,
                            fall_max = 2.5;
    static constexpr int patience_max = 1920;

  private:
    double median(std::size_t newest) const;
    double time_of(std::size_t point) const;
    bool is_overloaded(double target_ms) const;
    std::size_t back_from_spike(double target_ms);
    void arrived_at(std::size_t point, bool by_fall);
    void learn();

    std::vector<double> as_given_;
    std::vector<double> correction_;  // of as_given_ by what was seen, logarithms
    std::size_t point_ = 0;
    bool started_ = false;
    int frames_here_ = 0;         // at point_, those that settle too
    std::vector<double> recent_;  // newest last, at most frames_kept, at point_ and past settling
    double scaled_before_ = 0;    // ms without the fixed ones at point_before_ when it was left; 0: not known
    std::size_t point_before_ = 0;
    bool fell_here_ = false;  // point_ was reached by a fall
    double fixed_ms_ = 0;
    double known_ms_ = 0;  // last median, at known_point_
    std::size_t known_point_ = 0;
    int patience_ = frames_up;
    int since_up_ = 1 << 20;    // frames since the last move up
    int since_fall_ = 1 << 20;  // and since the first of the last falls, from fell_from_
    std::size_t fell_from_ = 0;
    int since_back_ = 1 << 20;
};

}  // namespace tarn
