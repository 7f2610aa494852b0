// Levelling of one line of cells in shared memory: what the level and pressure tiers do along x, z and the
// diagonals. Needs an array `grid` of GRID_CELLS ints: what a cell holds (lib/water.glsl), these flags, and what it
// held in the beginning, which levelling keeps.
#include "shared/hash.h"
#include "shared/water.h"
#include "lib/water.glsl"

const int CONTENT = 127;
const int STANDS = 128;    // something holds what is in it: solid, sand, or full water
const int ON_WATER = 256;  // and that is water
const int PRESSED = 512;   // by the head of confined water
const int CUT = 1024;      // no way to the next cell of a diagonal line
const int FLAGS = STANDS | ON_WATER | PRESSED | CUT;
const int BEFORE_SHIFT = 16;

shared int grid[GRID_CELLS];

struct LineRule {
    int film;             // quanta a cell that stay on dry ground
    int least;            // quanta a cell below which water over dry ground is left alone
    int rest_difference;  // largest minus smallest, in quanta, that counts as level
};

// Where a line lies in `grid`.
struct Line {
    int start, stride, count;
    int cut_at;  // 0: CUT of a cell is about the next; 1: about the one before
};

int content_in(int cell) { return cell & CONTENT; }
int content_before(int cell) { return cell >> BEFORE_SHIFT; }
bool takes_part(int cell) { return (cell & STANDS) != 0 && is_open(content_in(cell)); }

// Whether this invocation may have changed what a cell holds.
bool changed_here = false;

void set_content(int at, int content) {
    grid[at] = (grid[at] & ~CONTENT) | content;
    changed_here = true;
}

struct Extent {
    int total, most, least;
    int flags;  // that all share
};

Extent extent_of(Line line, int first, int last) {
    Extent e = Extent(0, 0, FULL, ON_WATER | PRESSED);
    for (int i = first; i <= last; ++i) {
        int cell = grid[line.start + i * line.stride];
        int content = content_in(cell);
        e.total += content;
        e.most = max(e.most, content);
        e.least = min(e.least, content);
        e.flags &= cell;
    }
    return e;
}

// `total` over the cells first..last, the remainder by chance: cell i gets floor(((i + 1) total + phase) / n) -
// floor((i total + phase) / n).
void spread(Line line, int first, int last, int total, uint chance) {
    int n = last - first + 1;
    int share = total / n;
    int remainder = total - share * n;
    int carried = int(chance % uint(n));
    for (int i = first; i <= last; ++i) {
        carried += remainder;
        int more = carried >= n ? 1 : 0;
        carried -= more * n;
        set_content(line.start + i * line.stride, share + more);
    }
}

// The wet part first..last of the run run_first..run_last may grow into dry cells as far as a film reaches. Returns
// where it ends.
int grow(Line line, int run_first, int run_last, int first, int last, LineRule rule, uint chance) {
    Extent wet = extent_of(line, first, last);
    int more = max(0, wet.total / rule.film - (last - first + 1));
    int left = 0;
    while (left < more && first - left > run_first &&
           content_in(grid[line.start + (first - left - 1) * line.stride]) == 0)
        ++left;
    int right = 0;
    while (right < more && last + right < run_last &&
           content_in(grid[line.start + (last + right + 1) * line.stride]) == 0)
        ++right;
    int odd = int(chance >> 4 & 1u);
    int left_share = min(left, (more + odd) / 2);
    int right_share = min(right, more - left_share);
    left_share = min(left, more - right_share);
    first -= left_share;
    last += right_share;
    bool changes = left_share + right_share > 0 || wet.most - wet.least > rule.rest_difference;
    if (changes) spread(line, first, last, wet.total, hash2(chance, uint(first - run_first)));
    return last;
}

// A run with less water than a film on dry ground takes.
void level_film(Line line, int run_first, int run_last, LineRule rule, uint chance) {
    // It spreads over water without end.
    for (int first = run_first; first <= run_last; ++first) {
        if ((grid[line.start + first * line.stride] & ON_WATER) == 0) continue;
        int last = first;
        while (last < run_last && (grid[line.start + (last + 1) * line.stride] & ON_WATER) != 0) ++last;
        Extent part = extent_of(line, first, last);
        if (part.most - part.least > rule.rest_difference)
            spread(line, first, last, part.total, hash2(chance, uint(first - run_first)));
        first = last;
    }
    int first = rule.least > 0 ? run_last + 1 : run_first;
    for (; first <= run_last; ++first) {
        if (content_in(grid[line.start + first * line.stride]) == 0) continue;
        int last = first;
        while (last < run_last && content_in(grid[line.start + (last + 1) * line.stride]) > 0) ++last;
        first = max(last, grow(line, run_first, run_last, first, last, rule, chance));
    }
}

// Room in a cell, if it is one that water falls into.
int room_of_drop(int cell) {
    return (cell & STANDS) == 0 && is_open(content_in(cell)) ? FULL - content_in(cell) : 0;
}

// Levels every run of open cells that stand; water at the end of a run falls into an open cell that does not stand.
// llvmpipe runs the body of a branch for lanes that do not take it, but not that of a loop: so what few runs need
// stands in loops that run at most once.
void level_line(Line line, LineRule rule, uint chance) {
    if ((chance & 1u) != 0u)
        line = Line(line.start + (line.count - 1) * line.stride, -line.stride, line.count, 1);
    int first = 0;
    while (first < line.count) {
        int cell = grid[line.start + first * line.stride];
        while (first < line.count && !takes_part(cell)) {
            ++first;
            cell = first < line.count ? grid[line.start + first * line.stride] : 0;
        }
        // The run and what it holds; then `cell` is the one behind it, i its place.
        Extent all = Extent(0, 0, FULL, ON_WATER | PRESSED);
        bool cut_before = line.cut_at == 1 && (cell & CUT) != 0;
        bool cut = false;
        int i = first;
        bool way = takes_part(cell);
        while (way) {
            int content = content_in(cell);
            all.total += content;
            all.most = max(all.most, content);
            all.least = min(all.least, content);
            all.flags &= cell;
            int cut_cell = cell;
            ++i;
            cell = i < line.count ? grid[line.start + i * line.stride] : 0;
            cut = ((line.cut_at == 0 ? cut_cell : cell) & CUT) != 0;
            way = takes_part(cell) && !cut;
        }
        int n = i - first;
        bool on_water = (all.flags & ON_WATER) != 0;
        bool moves = all.total > 0 && (all.flags & PRESSED) == 0;
        int room_before = 0;
        int room_after = moves && i < line.count && !cut ? room_of_drop(cell) : 0;
        if (first > 0 && moves) {
            int before = grid[line.start + (first - 1) * line.stride];
            cut_before = cut_before || (line.cut_at == 0 && (before & CUT) != 0);
            room_before = cut_before ? 0 : room_of_drop(before);
        }
        bool drops = moves && room_before + room_after > 0 &&
                     (rule.least == 0 || on_water || all.total >= rule.least * n);
        moves = moves && (drops || all.most - all.least > rule.rest_difference);
        bool film = moves && !drops && !on_water && all.total < max(rule.film, rule.least) * n;
        bool spreads = moves && !film;
        uint run_chance = hash2(chance, uint(first));
        while (drops) {
            int leaving = min(all.total, room_before + room_after);
            int odd = int(run_chance >> 3 & 1u);
            int before = min(room_before, (leaving + odd) / 2);
            int after = min(room_after, leaving - before);
            before = min(room_before, leaving - after);
            if (before > 0) set_content(line.start + (first - 1) * line.stride, FULL - room_before + before);
            if (after > 0) set_content(line.start + i * line.stride, FULL - room_after + after);
            all.total -= leaving;
            drops = false;
        }
        while (spreads) {
            spread(line, first, i - 1, all.total, run_chance);
            spreads = false;
        }
        while (film) {
            level_film(line, first, i - 1, rule, run_chance);
            film = false;
        }
        first = i;
    }
}

uint line_chance(uint chance, int kind, int y, int line) {
    return hash2(chance, uint(kind << 16 | y << 8 | line));
}
