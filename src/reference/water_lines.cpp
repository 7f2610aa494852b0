#include "reference/water_lines.h"

#include <algorithm>

#include "shared/hash.h"
#include "shared/materials.h"

namespace tarn::reference {

namespace {

struct Extent {
    int total = 0, most = 0, least = full;
    bool on_water = true;  // all of it
    bool pressed = true;
};

Extent extent_of(std::span<const LineCell> cells) {
    Extent e;
    for (const LineCell& cell : cells) {
        e.total += cell.content;
        e.most = std::max(e.most, cell.content);
        e.least = std::min(e.least, cell.content);
        e.on_water = e.on_water && cell.on_water;
        e.pressed = e.pressed && cell.pressed;
    }
    return e;
}

bool spread(std::span<LineCell> cells, int total, std::uint32_t chance) {
    const int n = static_cast<int>(cells.size());
    const int phase = static_cast<int>(chance % static_cast<std::uint32_t>(n));
    bool changed = false;
    int before = phase / n;
    for (int i = 0; i < n; ++i) {
        const int after = ((i + 1) * total + phase) / n;
        changed = changed || cells[i].content != after - before;
        cells[i].content = after - before;
        before = after;
    }
    return changed;
}

// The wet part [first, last] of a run may grow into dry cells as far as a film of `film` quanta reaches.
bool grow(std::span<LineCell> run, int& first, int& last, const LineRule& rule, std::uint32_t chance) {
    const int n = static_cast<int>(run.size());
    const Extent wet = extent_of(run.subspan(first, last - first + 1));
    const int more = std::max(0, wet.total / rule.film - (last - first + 1));
    int left = 0;
    while (left < more && first - left > 0 && run[first - left - 1].content == 0) ++left;
    int right = 0;
    while (right < more && last + right + 1 < n && run[last + right + 1].content == 0) ++right;
    const int odd = static_cast<int>(chance >> 4 & 1u);
    int left_share = std::min(left, (more + odd) / 2);
    const int right_share = std::min(right, more - left_share);
    left_share = std::min(left, more - right_share);
    first -= left_share;
    last += right_share;
    if (left_share + right_share == 0 && wet.most - wet.least <= rule.rest_difference) return false;
    return spread(run.subspan(first, last - first + 1), wet.total,
                  hash2(chance, static_cast<std::uint32_t>(first)));
}

bool level_run(std::span<LineCell> run, const LineRule& rule, std::uint32_t chance) {
    const int n = static_cast<int>(run.size());
    const Extent all = extent_of(run);
    if (all.total == 0 || all.pressed || all.most - all.least <= rule.rest_difference) return false;
    const int least_over_ground = std::max(rule.film, rule.least);
    if (all.on_water || all.total >= least_over_ground * n) return spread(run, all.total, chance);
    bool changed = false;
    // A film spreads over water without end.
    for (int first = 0; first < n; ++first) {
        if (!run[first].on_water) continue;
        int last = first;
        while (last + 1 < n && run[last + 1].on_water) ++last;
        const auto part = run.subspan(first, last - first + 1);
        const Extent e = extent_of(part);
        if (e.most - e.least > rule.rest_difference)
            changed = spread(part, e.total, hash2(chance, static_cast<std::uint32_t>(first))) || changed;
        first = last;
    }
    if (rule.least > 0) return changed;
    for (int first = 0; first < n; ++first) {
        if (run[first].content == 0) continue;
        int last = first;
        while (last + 1 < n && run[last + 1].content > 0) ++last;
        const int next = last;
        changed = grow(run, first, last, rule, chance) || changed;
        first = std::max(next, last);
    }
    return changed;
}

}  // namespace

int content_of(std::uint8_t byte) {
    if (byte == MATERIAL_AIR) return 0;
    if (byte == MATERIAL_SAND) return content_sand;
    return is_water(byte) ? static_cast<int>(quanta_of(byte)) : content_closed;
}

std::uint8_t byte_of_content(int content) {
    return static_cast<std::uint8_t>(
        content == content_sand ? MATERIAL_SAND : water_cell(static_cast<std::uint32_t>(content)));
}

bool level_line(std::span<LineCell> line, const LineRule& rule, std::uint32_t chance) {
    const int n = static_cast<int>(line.size());
    const auto takes_part = [&](int i) { return is_open(line[i].content) && line[i].stands; };
    const auto room_of_drop = [&](int i) {
        return is_open(line[i].content) && !line[i].stands ? full - line[i].content : 0;
    };
    bool changed = false;
    for (int first = 0; first < n; ++first) {
        if (!takes_part(first)) continue;
        int last = first;
        while (last + 1 < n && takes_part(last + 1) && !line[last].cut) ++last;
        const auto run = line.subspan(first, last - first + 1);
        const std::uint32_t run_chance = hash2(chance, static_cast<std::uint32_t>(first));
        const Extent all = extent_of(run);
        const int room_before = first > 0 && !line[first - 1].cut ? room_of_drop(first - 1) : 0;
        const int room_after = last + 1 < n && !line[last].cut ? room_of_drop(last + 1) : 0;
        const bool enough =
            rule.least == 0 || all.on_water || all.total >= rule.least * static_cast<int>(run.size());
        if (room_before + room_after > 0 && all.total > 0 && !all.pressed && enough) {
            const int leaving = std::min(all.total, room_before + room_after);
            const int odd = static_cast<int>(run_chance >> 3 & 1u);
            int before = std::min(room_before, (leaving + odd) / 2);
            const int after = std::min(room_after, leaving - before);
            before = std::min(room_before, leaving - after);
            if (before > 0) line[first - 1].content += before;
            if (after > 0) line[last + 1].content += after;
            spread(run, all.total - leaving, run_chance);
            changed = true;
        } else {
            changed = level_run(run, rule, run_chance) || changed;
        }
        first = last;
    }
    return changed;
}

}  // namespace tarn::reference
