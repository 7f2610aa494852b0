// Levelling of one line of cells in shared memory: what the level and pressure tiers do along x, z and the
// diagonals. Needs an array `grid` of GRID_CELLS ints: what a cell holds (lib/water.glsl) and these flags, which
// levelling keeps.
#include "shared/hash.h"
#include "shared/water.h"
#include "lib/water.glsl"

const int CONTENT = 127;
const int STANDS = 128;    // something holds what is in it: solid, sand, or full water
const int ON_WATER = 256;  // and that is water
const int PRESSED = 512;   // by the head of confined water

shared int grid[GRID_CELLS];

struct LineRule {
    int film;             // quanta a cell that stay on dry ground
    int least;            // quanta a cell below which water over dry ground is left alone
    int rest_difference;  // largest minus smallest, in quanta, that counts as level
};

// Where a line lies in `grid`, and the steps to the two cells that its diagonal steps pass between; 0, 0 along axes.
struct Line {
    int start, stride, count;
    int side_a, side_b;
};

int line_index(Line line, int i) { return line.start + i * line.stride; }
int content_in(int cell) { return cell & CONTENT; }
bool takes_part(int cell) { return is_open(content_in(cell)) && (cell & STANDS) != 0; }

void set_content(Line line, int i, int content) {
    int at = line_index(line, i);
    grid[at] = (grid[at] & ~CONTENT) | content;
}

// Whether there is no way from cell i to the next.
bool is_cut(Line line, int i) {
    if (line.side_a == 0) return false;
    int at = line_index(line, i);
    return !is_open(content_in(grid[at + line.side_a])) && !is_open(content_in(grid[at + line.side_b]));
}

struct Extent {
    int total, most, least;
    int flags;  // ON_WATER and PRESSED where they hold for all
};

Extent extent_of(Line line, int first, int last) {
    Extent e = Extent(0, 0, FULL, ON_WATER | PRESSED);
    for (int i = first; i <= last; ++i) {
        int cell = grid[line_index(line, i)];
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
        set_content(line, i, share + more);
    }
}

// The wet part first..last of the run run_first..run_last may grow into dry cells as far as a film reaches. Returns
// where it ends.
int grow(Line line, int run_first, int run_last, int first, int last, LineRule rule, uint chance) {
    Extent wet = extent_of(line, first, last);
    int more = max(0, wet.total / rule.film - (last - first + 1));
    int left = 0;
    while (left < more && first - left > run_first && content_in(grid[line_index(line, first - left - 1)]) == 0) ++left;
    int right = 0;
    while (right < more && last + right < run_last && content_in(grid[line_index(line, last + right + 1)]) == 0) ++right;
    int odd = int(chance >> 4 & 1u);
    int left_share = min(left, (more + odd) / 2);
    int right_share = min(right, more - left_share);
    left_share = min(left, more - right_share);
    first -= left_share;
    last += right_share;
    if (left_share + right_share > 0 || wet.most - wet.least > rule.rest_difference)
        spread(line, first, last, wet.total, hash2(chance, uint(first - run_first)));
    return last;
}

void level_run(Line line, int run_first, int run_last, Extent all, LineRule rule, uint chance) {
    if (all.total == 0 || (all.flags & PRESSED) != 0 || all.most - all.least <= rule.rest_difference) return;
    int n = run_last - run_first + 1;
    if ((all.flags & ON_WATER) != 0 || all.total >= max(rule.film, rule.least) * n) {
        spread(line, run_first, run_last, all.total, chance);
        return;
    }
    // A film spreads over water without end.
    for (int first = run_first; first <= run_last; ++first) {
        if ((grid[line_index(line, first)] & ON_WATER) == 0) continue;
        int last = first;
        while (last < run_last && (grid[line_index(line, last + 1)] & ON_WATER) != 0) ++last;
        Extent part = extent_of(line, first, last);
        if (part.most - part.least > rule.rest_difference)
            spread(line, first, last, part.total, hash2(chance, uint(first - run_first)));
        first = last;
    }
    if (rule.least > 0) return;
    for (int first = run_first; first <= run_last; ++first) {
        if (content_in(grid[line_index(line, first)]) == 0) continue;
        int last = first;
        while (last < run_last && content_in(grid[line_index(line, last + 1)]) > 0) ++last;
        first = max(last, grow(line, run_first, run_last, first, last, rule, chance));
    }
}

// Room in cell i, if it is one that water falls into.
int room_of_drop(Line line, int i) {
    int cell = grid[line_index(line, i)];
    return is_open(content_in(cell)) && (cell & STANDS) == 0 ? FULL - content_in(cell) : 0;
}

// Levels every run of open cells that stand; water at the end of a run falls into an open cell that does not stand.
void level_line(Line line, LineRule rule, uint chance) {
    if ((chance & 1u) != 0u)
        line = Line(line_index(line, line.count - 1), -line.stride, line.count, -line.side_a, -line.side_b);
    for (int first = 0; first < line.count; ++first) {
        if (!takes_part(grid[line_index(line, first)])) continue;
        int last = first;
        while (last + 1 < line.count && takes_part(grid[line_index(line, last + 1)]) && !is_cut(line, last)) ++last;
        uint run_chance = hash2(chance, uint(first));
        Extent all = extent_of(line, first, last);
        int room_before = first > 0 && !is_cut(line, first - 1) ? room_of_drop(line, first - 1) : 0;
        int room_after = last + 1 < line.count && !is_cut(line, last) ? room_of_drop(line, last + 1) : 0;
        bool enough = rule.least == 0 || (all.flags & ON_WATER) != 0 || all.total >= rule.least * (last - first + 1);
        if (room_before + room_after > 0 && all.total > 0 && (all.flags & PRESSED) == 0 && enough) {
            int leaving = min(all.total, room_before + room_after);
            int odd = int(run_chance >> 3 & 1u);
            int before = min(room_before, (leaving + odd) / 2);
            int after = min(room_after, leaving - before);
            before = min(room_before, leaving - after);
            if (before > 0) set_content(line, first - 1, FULL - room_before + before);
            if (after > 0) set_content(line, last + 1, FULL - room_after + after);
            spread(line, first, last, all.total - leaving, run_chance);
        } else {
            level_run(line, first, last, all, rule, run_chance);
        }
        first = last;
    }
}

uint line_chance(uint chance, int kind, int y, int line) {
    return hash2(chance, uint(kind << 16 | y << 8 | line));
}
