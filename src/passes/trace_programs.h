// The programs of the trace pass, by what they can do. With a context to share, those that a picture comes to
// need are built on a thread of their own, while one that can do more serves: no frame waits for the
// compiler. Owns that thread.
#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "gl/context.h"
#include "passes/trace_pass.h"

namespace tarn {

// Whether a program of `able` can do all that one of `needed` does.
bool includes(const TraceFeatures& able, const TraceFeatures& needed);

class TracePrograms {
  public:
    // `context` null: each program is built when it is asked for.
    explicit TracePrograms(std::unique_ptr<gl::SharedContext> context = nullptr);
    ~TracePrograms();  // waits for the program that is being built
    TracePrograms(const TracePrograms&) = delete;
    TracePrograms& operator=(const TracePrograms&) = delete;

    struct Choice {
        const TracePass& pass;
        // Draws the picture that is asked for, to the bit. Otherwise it differs in how light is sampled or
        // water is shaded, until a setting that was changed takes effect.
        bool exact;
    };
    // The program of `needed`, or one that serves until it is built. `general`: `needed`, and all that the
    // scene can come to need under the same settings; no program between the two changes a bit of the
    // picture. Throws Error where a program is built at once and does not compile.
    Choice choose(const TraceFeatures& needed, const TraceFeatures& general, const TraceShapes& shapes);

    // The same for a picture that can wait, apart from the one on show: draws exactly what `needed` does;
    // null until there is one. Does not count as a choice: what serves the shown picture stays as it is.
    const TracePass* find(const TraceFeatures& needed, const TraceFeatures& general,
                          const TraceShapes& shapes);

    // Until all that was asked for is built.
    void wait();
    double waited_ms() const { return waited_ms_; }  // for programs that were built at once
    std::size_t size() const { return passes_.size(); }

    void poll_reload(std::vector<std::string>& messages);

  private:
    struct Order {
        TraceFeatures features;
        TraceShapes shapes;
        std::uint32_t sources;  // when it was ordered
    };
    struct Built {
        TraceFeatures features;
        std::uint32_t sources;
        std::optional<TracePass> pass;
        std::string error;  // where there is no pass
        std::chrono::steady_clock::time_point at{};
    };
    void work();
    static Built build(const Order& order);
    void order(const TraceFeatures& features, const TraceShapes& shapes);
    void collect(bool settled);
    const TracePass& build_now(const TraceFeatures& features);
    const TracePass* smallest_between(const TraceFeatures& needed, const TraceFeatures& general) const;

    std::map<TraceFeatures, TracePass> passes_;
    std::set<TraceFeatures> ordered_, failed_;  // under way; not tried again until a shader changes
    std::uint32_t sources_ = 0;                 // counts their changes
    std::vector<std::string> errors_;
    TraceFeatures last_{};
    bool exact_ = true;  // the last choice
    double waited_ms_ = 0;

    std::unique_ptr<gl::SharedContext> context_;
    std::mutex mutex_;  // of what follows
    std::condition_variable changed_;
    std::deque<Order> orders_;
    std::vector<Built> built_;
    bool busy_ = false, stop_ = false;
    std::thread worker_;
};

}  // namespace tarn
