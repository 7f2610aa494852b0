#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace tarn {

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)),
      total_(std::max<std::uint64_t>(total, 1)),
      terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (drawn_) fmt::print(stderr, "\r\033[K");
}

void Progress::show(std::uint64_t done) {
    const Clock::time_point now = Clock::now();
    if (!terminal_ || now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    drawn_ = true;
    constexpr std::uint64_t width = 30;
    const double part = static_cast<double>(std::min(done, total_)) / static_cast<double>(total_);
    const auto filled = static_cast<std::size_t>(part * width);
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const double left_s = part > 0 ? elapsed_s * (1 - part) / part : 0;
    fmt::print(stderr, "\r\033[K{} [{}{}] {}/{}, {:.0f} s left", what_, std::string(filled, '#'),
               std::string(width - filled, '.'), done, total_, left_s);
}

StepProgress::StepProgress() : terminal_(isatty(STDERR_FILENO) == 1) {}

StepProgress::~StepProgress() {
    if (terminal_) fmt::print(stderr, "\r\033[K");
}

void StepProgress::show(const std::string& what) {
    if (!terminal_) return;
    const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    fmt::print(stderr, "\r\033[K{:.0f} s: {}", elapsed_s, what);
}

}  // namespace tarn
