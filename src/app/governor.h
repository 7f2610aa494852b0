// Holds a frame time by moving along a list of points from fast to slow. Knows no clock and no settings: it
// is told what frames took and says at which point the next ones should be made.
#pragma once
#include <cstddef>
#include <vector>

namespace tarn {

class Governor {
  public:
    // `times`: of a frame at each point, in any unit; growing.
    explicit Governor(std::vector<double> times);

    // A frame took `ms` at `point`, whoever chose it. Returns the point for the next one; `point` itself
    // where target_ms is 0: then it only learns what to expect. A time that is not positive (or no number) is
    // no frame.
    std::size_t frame(double ms, std::size_t point, double target_ms);

    // What a frame would take at a point, from the last frames; 0: not known yet.
    double expected_ms(std::size_t point) const;

    // Moves up and down by a median over frames that are past the switch, down at once when that is above the
    // target by `slack_down`, up only where the next point is expected below it by `slack_up` and after a
    // patience that doubles whenever it had to come back.
    static constexpr int settle_frames = 4;  // after a switch: targets and programs are made
    static constexpr int frames_down = 9, frames_up = 30, frames_kept = 30;
    static constexpr double slack_down = 1.1, slack_up = 0.85, aim = 0.95;
    static constexpr int patience_max = 1920;

  private:
    double median(std::size_t newest) const;
    void arrived_at(std::size_t point);
    void learn();

    std::vector<double> times_;  // corrected by what was seen
    std::vector<double> as_given_;
    std::size_t point_ = 0;
    bool started_ = false;
    int frames_here_ = 0;         // at point_, those that settle too
    std::vector<double> recent_;  // newest last, at most frames_kept, at point_ and past settling
    double ms_before_ = 0;        // median at point_before_ when it was left; 0: not known
    std::size_t point_before_ = 0;
    double known_ms_ = 0;  // last median, at known_point_
    std::size_t known_point_ = 0;
    int patience_ = frames_up;
    int since_up_ = 1 << 20;  // frames since the last move up
};

}  // namespace tarn
