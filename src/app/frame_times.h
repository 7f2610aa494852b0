// How much of a frame's time is the same whatever the picture's quality (ticks, panels, the wait for the
// display). What the GPU took is known some frames later, so each frame's own times are compared. Knows no
// clock.
#pragma once
#include <deque>

namespace tarn {

class FrameTimes {
  public:
    static constexpr int frames_kept = 16;  // for which the picture's time may be under way
    static constexpr int frames_fixed = 5;  // whose median counts

    // Frame `frame` took `ms` from its begin to that of the next.
    void add_frame(long frame, double ms);
    // Of that the picture took so much. Frames that are not known, or were told of before, do not count.
    void add_picture(long frame, double ms);
    // Of the last frames; 0 before the first.
    double fixed_ms() const;

  private:
    struct Frame {
        long frame;
        double ms;
    };
    std::deque<Frame> frames_;  // without the picture's time, oldest first
    std::deque<double> fixed_ms_;
};

}  // namespace tarn
