// Levelling of one line of cells for the CPU's step: the rule of glsl/lib/level_line.glsl on 16-bit cells.
// All inline, so that each set of vector instructions gets its own.
#pragma once
#include <algorithm>
#include <cstdint>

#include "bench/cpu_cells.h"
#include "shared/hash.h"

namespace tarn::cpu {

// Of a cell: what it holds, and flags that levelling keeps.
constexpr int content_bits = 127;
constexpr int stands = 128;    // something holds what is in it
constexpr int on_water = 256;  // and that is water
constexpr int cut_next = 512;  // no way to the next cell of a diagonal line

struct LineRule {
    int film;             // quanta a cell that stay on dry ground
    int least;            // quanta a cell below which water over dry ground is left alone
    int rest_difference;  // largest minus smallest, in quanta, that counts as level
};

// The cells of a line from its first; `cut_at` 0: cut_next of a cell is about the next in this order, 1:
// about the one before.
struct Line {
    Cell* first;
    int stride, count, cut_at;
    Cell& operator[](int i) const { return first[i * stride]; }
};

inline int content(int cell) {
    return cell & content_bits;
}
inline bool takes_part(int cell) {
    return (cell & stands) != 0 && is_open(content(cell));
}
inline void set_content(Cell& cell, int to) {
    cell = static_cast<Cell>((cell & ~content_bits) | to);
}
inline int support_of(int below) {
    return (below >= full ? stands : 0) | (is_open(below) ? on_water : 0);
}

struct Extent {
    int total = 0, most = 0, least = full;
    bool over_water = true;
    void add(int cell) {
        total += content(cell);
        most = std::max(most, content(cell));
        least = std::min(least, content(cell));
        over_water = over_water && (cell & on_water) != 0;
    }
};

inline Extent extent_of(const Line& line, int first, int last) {
    Extent extent;
    for (int i = first; i <= last; ++i) extent.add(line[i]);
    return extent;
}

inline void spread(const Line& line, int first, int last, int total, std::uint32_t chance) {
    const int n = last - first + 1;
    const int share = total / n;
    const int remainder = total - share * n;
    int carried = static_cast<int>(chance % static_cast<std::uint32_t>(n));
    for (int i = first; i <= last; ++i) {
        carried += remainder;
        const int more = carried >= n ? 1 : 0;
        carried -= more * n;
        set_content(line[i], share + more);
    }
}

// Returns where the wet part ends that has grown as far as a film reaches.
inline int grow(const Line& line, int run_first, int run_last, int first, int last, const LineRule& rule,
                std::uint32_t chance) {
    const Extent wet = extent_of(line, first, last);
    const int more = std::max(0, wet.total / rule.film - (last - first + 1));
    int left = 0;
    while (left < more && first - left > run_first && content(line[first - left - 1]) == 0) ++left;
    int right = 0;
    while (right < more && last + right < run_last && content(line[last + right + 1]) == 0) ++right;
    const int odd = static_cast<int>(chance >> 4 & 1u);
    int left_share = std::min(left, (more + odd) / 2);
    const int right_share = std::min(right, more - left_share);
    left_share = std::min(left, more - right_share);
    first -= left_share;
    last += right_share;
    if (left_share + right_share > 0 || wet.most - wet.least > rule.rest_difference)
        spread(line, first, last, wet.total, hash2(chance, static_cast<std::uint32_t>(first - run_first)));
    return last;
}

inline void level_film(const Line& line, int run_first, int run_last, const LineRule& rule,
                       std::uint32_t chance) {
    for (int first = run_first; first <= run_last; ++first) {
        if ((line[first] & on_water) == 0) continue;
        int last = first;
        while (last < run_last && (line[last + 1] & on_water) != 0) ++last;
        const Extent part = extent_of(line, first, last);
        if (part.most - part.least > rule.rest_difference)
            spread(line, first, last, part.total,
                   hash2(chance, static_cast<std::uint32_t>(first - run_first)));
        first = last;
    }
    if (rule.least > 0) return;
    for (int first = run_first; first <= run_last; ++first) {
        if (content(line[first]) == 0) continue;
        int last = first;
        while (last < run_last && content(line[last + 1]) > 0) ++last;
        first = std::max(last, grow(line, run_first, run_last, first, last, rule, chance));
    }
}

inline int room_of_drop(int cell) {
    return (cell & stands) == 0 && is_open(content(cell)) ? full - content(cell) : 0;
}

inline void level_line(Line line, const LineRule& rule, std::uint32_t chance) {
    if ((chance & 1u) != 0) line = {line.first + (line.count - 1) * line.stride, -line.stride, line.count, 1};
    const auto cut_after = [&](int i) {  // between cells i and i + 1
        return (line[line.cut_at == 0 ? i : i + 1] & cut_next) != 0;
    };
    for (int first = 0; first < line.count; ++first) {
        if (!takes_part(line[first])) continue;
        Extent all;
        all.add(line[first]);
        int last = first;
        while (last + 1 < line.count && takes_part(line[last + 1]) && !cut_after(last)) all.add(line[++last]);
        const int run_first = first;
        first = last;
        if (all.total == 0) continue;
        const int n = last - run_first + 1;
        const int room_before =
            run_first > 0 && !cut_after(run_first - 1) ? room_of_drop(line[run_first - 1]) : 0;
        const int room_after = last + 1 < line.count && !cut_after(last) ? room_of_drop(line[last + 1]) : 0;
        const bool drops = room_before + room_after > 0 &&
                           (rule.least == 0 || all.over_water || all.total >= rule.least * n);
        if (!drops && all.most - all.least <= rule.rest_difference) continue;
        const std::uint32_t run_chance = hash2(chance, static_cast<std::uint32_t>(run_first));
        if (drops) {
            const int leaving = std::min(all.total, room_before + room_after);
            const int odd = static_cast<int>(run_chance >> 3 & 1u);
            int before = std::min(room_before, (leaving + odd) / 2);
            const int after = std::min(room_after, leaving - before);
            before = std::min(room_before, leaving - after);
            if (before > 0) set_content(line[run_first - 1], full - room_before + before);
            if (after > 0) set_content(line[last + 1], full - room_after + after);
            spread(line, run_first, last, all.total - leaving, run_chance);
        } else if (!all.over_water && all.total < std::max(rule.film, rule.least) * n) {
            level_film(line, run_first, last, rule, run_chance);
        } else {
            spread(line, run_first, last, all.total, run_chance);
        }
    }
}

inline std::uint32_t line_chance(std::uint32_t chance, int kind, int y, int line) {
    return hash2(chance, static_cast<std::uint32_t>(kind << 16 | y << 8 | line));
}

}  // namespace tarn::cpu
