// GPU time by pass, from timestamp queries that are collected frames later and never wait, unless told to.
#pragma once
#include <glad/gl.h>

#include <array>
#include <string>
#include <vector>

namespace tarn::gl {

struct PassTime {
    std::string name;
    double last_ms = 0;
    double mean_ms = 0;   // exponential mean over about 16 frames
    double total_ms = 0;  // since the start
    long frames = 0;      // frames with this pass
    long last_frame = 0;  // the last of these, by the end_frame() calls before it
};

class Timers {
  public:
    // One pass: opens a debug group and two timestamps, closes both at the end of its scope.
    class Scope {
      public:
        Scope(Timers& timers, const char* name);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        Timers& timers_;
        GLuint end_query_ = 0;
    };

    Timers() = default;
    ~Timers();
    Timers(const Timers&) = delete;
    Timers& operator=(const Timers&) = delete;

    [[nodiscard]] Scope scope(const char* name) { return Scope(*this, name); }

    // Once a frame: takes the results that have arrived.
    void end_frame();
    // Waits for all of them.
    void finish();

    const std::vector<PassTime>& passes() const { return passes_; }
    long frame() const { return frame_; }            // end_frame() calls so far
    long last_frame() const { return last_frame_; }  // whose passes are all known; -1: none yet

  private:
    struct Pending {
        std::size_t pass;
        GLuint begin, end;
        long frame;
    };
    GLuint take_query();
    void collect(bool wait);

    std::vector<PassTime> passes_;
    std::vector<double> frame_sum_ms_;  // of the frame being collected, by pass
    std::vector<Pending> pending_;
    std::vector<GLuint> free_;
    long frame_ = 0;
    long collecting_ = 0;
    long last_frame_ = -1;
};

}  // namespace tarn::gl
