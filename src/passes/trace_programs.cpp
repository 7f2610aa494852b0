#include "passes/trace_programs.h"

#include <algorithm>
#include <array>

#include "core/error.h"

namespace tarn {

namespace {

// What was made at another context's first draw comes to ours through Mesa's cache on disk, which is written
// behind, at the lowest priority: taken at once, a program would be compiled a second time. While another
// serves there is time.
constexpr std::chrono::milliseconds settles{1000};

std::array<bool, 9> flags(const TraceFeatures& f) {
    return {f.skip, f.clear, f.rough, f.coated, f.sun, f.sky, f.emitters, f.smooth_water, f.count};
}

// Without what only decides how light is found and how the world is walked: pictures agree up to noise.
TraceFeatures content_of(TraceFeatures f) {
    f.skip = f.sun = f.sky = f.emitters = f.smooth_water = false;
    return f;
}

}  // namespace

bool includes(const TraceFeatures& able, const TraceFeatures& needed) {
    const auto a = flags(able);
    const auto n = flags(needed);
    return std::equal(a.begin(), a.end(), n.begin(), [](bool has, bool needs) { return has || !needs; });
}

TracePrograms::TracePrograms(std::unique_ptr<gl::SharedContext> context) : context_(std::move(context)) {
    if (context_) worker_ = std::thread([this] { work(); });
}

TracePrograms::~TracePrograms() {
    if (!worker_.joinable()) return;
    {
        const std::scoped_lock lock(mutex_);
        stop_ = true;
    }
    changed_.notify_all();
    worker_.join();
}

TracePrograms::Built TracePrograms::build(const Order& order) {
    Built built{order.features, order.sources, std::nullopt, ""};
    try {
        built.pass.emplace(order.features);
        built.pass->rehearse(order.shapes);
    } catch (const Error& error) {
        built.pass.reset();
        built.error = error.what();
    }
    return built;
}

void TracePrograms::work() {
    std::string no_context;
    try {
        context_->make_current();
        gl::watch_errors();
    } catch (const Error& error) {
        no_context = error.what();
    }
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return stop_ || !orders_.empty(); });
        if (stop_) break;
        const Order order = orders_.front();
        orders_.pop_front();
        busy_ = true;
        lock.unlock();
        Built built = no_context.empty() ? build(order)
                                         : Built{order.features, order.sources, std::nullopt, no_context};
        lock.lock();
        built.at = std::chrono::steady_clock::now();
        built_.push_back(std::move(built));
        busy_ = false;
        changed_.notify_all();
    }
    // Programs are the share group's: whoever is left deletes them.
    lock.unlock();
    if (no_context.empty()) context_->release();
}

void TracePrograms::order(const TraceFeatures& features, const TraceShapes& shapes) {
    if (passes_.contains(features) || failed_.contains(features) || !ordered_.insert(features).second) return;
    {
        const std::scoped_lock lock(mutex_);
        orders_.push_back({features, shapes, sources_});
    }
    changed_.notify_all();
}

void TracePrograms::collect(bool settled) {
    const auto now = std::chrono::steady_clock::now();
    std::vector<Built> built;
    {
        const std::scoped_lock lock(mutex_);
        const auto ready = std::stable_partition(
            built_.begin(), built_.end(), [&](const Built& b) { return settled && now - b.at < settles; });
        std::move(ready, built_.end(), std::back_inserter(built));
        built_.erase(ready, built_.end());
    }
    for (Built& b : built) {
        ordered_.erase(b.features);
        if (b.pass) {
            passes_.try_emplace(b.features, std::move(*b.pass));
            continue;
        }
        errors_.push_back(b.error);
        // Of sources that have changed meanwhile it says nothing.
        if (b.sources == sources_) failed_.insert(b.features);
    }
}

const TracePass& TracePrograms::build_now(const TraceFeatures& features) {
    const auto start = std::chrono::steady_clock::now();
    const TracePass& pass = passes_.try_emplace(features, features).first->second;
    waited_ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return pass;
}

const TracePass* TracePrograms::smallest_between(const TraceFeatures& needed,
                                                 const TraceFeatures& general) const {
    const TracePass* smallest = nullptr;
    std::ptrdiff_t fewest = 0;
    for (const auto& [features, pass] : passes_) {
        if (!includes(features, needed) || !includes(general, features)) continue;
        const auto all = flags(features);
        const std::ptrdiff_t count = std::count(all.begin(), all.end(), true);
        if (smallest != nullptr && count >= fewest) continue;
        smallest = &pass;
        fewest = count;
    }
    return smallest;
}

TracePrograms::Choice TracePrograms::choose(const TraceFeatures& needed, const TraceFeatures& general,
                                            const TraceShapes& shapes) {
    collect(exact_);
    const auto found = passes_.find(needed);
    if (found == passes_.end() && (!worker_.joinable() || passes_.empty() || needed.count)) {
        // The general one is not ordered yet: the first frame has the machine for itself.
        const TracePass& pass = build_now(needed);
        last_ = needed;
        exact_ = true;
        return {pass, true};
    }
    if (!worker_.joinable()) return {found->second, true};
    const TracePass* pass = found != passes_.end() ? &found->second : smallest_between(needed, general);
    const auto last = passes_.find(last_);
    bool exact = pass != nullptr;
    if (!exact && last != passes_.end() && includes(content_of(last_), content_of(needed)))
        pass = &last->second;
    if (pass == nullptr) {
        // Early in the first run ever: the general one is on its way, and sooner there than another beside
        // it.
        order(general, shapes);
        wait();
        collect(false);
        pass = smallest_between(needed, general);
        if (pass == nullptr) pass = &build_now(needed);
        exact = true;
    }
    order(needed, shapes);
    if (!needed.count) order(general, shapes);
    last_ = pass->features();
    exact_ = exact;
    return {*pass, exact};
}

const TracePass* TracePrograms::find(const TraceFeatures& needed, const TraceFeatures& general,
                                     const TraceShapes& shapes) {
    collect(exact_);
    const auto found = passes_.find(needed);
    if (found != passes_.end()) return &found->second;
    if (!worker_.joinable()) return &build_now(needed);
    order(needed, shapes);
    return smallest_between(needed, general);
}

void TracePrograms::wait() {
    if (!worker_.joinable()) return;
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return orders_.empty() && !busy_; });
}

void TracePrograms::poll_reload(std::vector<std::string>& messages) {
    messages.insert(messages.end(), errors_.begin(), errors_.end());
    errors_.clear();
    bool reloaded = false;
    for (auto& [features, pass] : passes_) {
        if (auto message = pass.program().poll_reload()) {
            messages.push_back(*message);
            reloaded = true;
        }
    }
    if (!reloaded) return;
    // What failed before may compile now.
    ++sources_;
    failed_.clear();
}

}  // namespace tarn
