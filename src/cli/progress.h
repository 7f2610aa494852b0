// A progress bar on stderr for long runs; silent where stderr is no terminal.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace tarn {

class Progress {
  public:
    Progress(std::string what, std::uint64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    // Draws at most ten times a second.
    void show(std::uint64_t done);

  private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    std::uint64_t total_;
    bool terminal_;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point next_ = Clock::now() + std::chrono::milliseconds(300);
};

// For work of unknown length: the time so far and what is being done, on a line of stderr that is a terminal.
class StepProgress {
  public:
    StepProgress();
    ~StepProgress();
    StepProgress(const StepProgress&) = delete;
    StepProgress& operator=(const StepProgress&) = delete;
    void show(const std::string& what);

  private:
    bool terminal_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tarn
