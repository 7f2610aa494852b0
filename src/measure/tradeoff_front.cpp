// The points of the slider, chosen from what was measured.
#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/tradeoff_table.h"

namespace tarn {

namespace {

// Times are measured to about this; nearer points count as one.
constexpr double time_step = 1.1;

struct Candidate {
    Measured measured;
    Nearest nearest;
    bool is_quality, kept;
};

double distance(const Candidate& a, const Candidate& b) {
    return std::abs(std::log(a.measured.time / b.measured.time));
}

// The front's points, and the qualities that none beats by more than what measuring is worth; those take the
// place of what is near them.
std::vector<Candidate> candidates_of(const std::vector<Measured>& measured) {
    std::vector<Candidate> candidates;
    for (const Measured& m : measured) {
        const Nearest nearest = nearest_quality(m.configuration);
        const bool beaten = std::any_of(measured.begin(), measured.end(), [&](const Measured& o) {
            return o.eligible && o.time * beaten_factor < m.time && o.error * beaten_factor < m.error;
        });
        if (nearest.differs.empty() && nearest.quality != Quality::Baseline && m.eligible && !beaten)
            candidates.push_back({m, nearest, true, true});
    }
    const std::size_t qualities = candidates.size();
    for (const std::size_t i : pareto_front(measured)) {
        const Candidate point{measured[i], nearest_quality(measured[i].configuration), false, false};
        const auto is_near = [&](const Candidate& q) { return distance(q, point) < std::log(time_step); };
        if (std::none_of(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(qualities),
                         is_near))
            candidates.push_back(point);
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const auto& a, const auto& b) { return a.measured.time < b.measured.time; });
    std::vector<Candidate> falling;
    for (const Candidate& c : candidates) {
        while (!falling.empty() && c.is_quality && !falling.back().is_quality &&
               falling.back().measured.error <= c.measured.error)
            falling.pop_back();
        if (falling.empty() || c.measured.error < falling.back().measured.error) falling.push_back(c);
    }
    return falling;
}

}  // namespace

std::vector<FrontPoint> front_points(std::span<const TradeoffRow> rows, int points_max) {
    std::vector<Candidate> candidates = candidates_of(over_all(rows));
    if (candidates.empty()) return {};
    candidates.front().kept = candidates.back().kept = true;
    const auto kept = [&] {
        return std::count_if(candidates.begin(), candidates.end(), [](const Candidate& c) { return c.kept; });
    };
    while (kept() < std::min<std::ptrdiff_t>(points_max, std::ssize(candidates))) {
        Candidate* farthest = nullptr;
        double most = std::log(time_step);
        for (Candidate& c : candidates) {
            if (c.kept) continue;
            double least = std::numeric_limits<double>::infinity();
            for (const Candidate& other : candidates)
                if (other.kept) least = std::min(least, distance(c, other));
            if (least <= most) continue;
            most = least;
            farthest = &c;
        }
        if (farthest == nullptr) break;
        farthest->kept = true;
    }
    std::vector<FrontPoint> points;
    for (const Candidate& c : candidates)
        if (c.kept)
            points.push_back({.quality = c.nearest.quality,
                              .set = c.nearest.differs,
                              .time = c.measured.time,
                              .error = c.measured.error});
    return points;
}

}  // namespace tarn
