// One line of cells, levelled: what the level and pressure tiers do to it.
#include "reference/water_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>
#include <vector>

#include "shared/materials.h"

namespace tarn::reference {
namespace {

using Line = std::vector<LineCell>;

constexpr LineRule axis{};
constexpr LineRule wide{.film = 3, .least = 8, .rest_difference = 1};

// Cells that stand, on water or on ground.
Line line_of(const std::vector<int>& contents, bool on_water) {
    Line line;
    for (const int content : contents)
        line.push_back({.content = content, .stands = true, .on_water = on_water});
    return line;
}

std::vector<int> contents_of(const Line& line) {
    std::vector<int> contents;
    for (const LineCell& cell : line) contents.push_back(cell.content);
    return contents;
}

int total_of(const Line& line) {
    return std::accumulate(line.begin(), line.end(), 0, [](int sum, const LineCell& cell) {
        return sum + (is_open(cell.content) ? cell.content : 0);
    });
}

int spread_of(const Line& line) {
    const auto contents = contents_of(line);
    return *std::max_element(contents.begin(), contents.end()) -
           *std::min_element(contents.begin(), contents.end());
}

Line random_line(std::mt19937& random) {
    Line line(1 + random() % 64);
    const bool wet = random() % 2 == 0;
    for (LineCell& cell : line) {
        const auto kind = random() % 16;
        cell.content = kind == 0   ? content_closed
                       : kind == 1 ? content_sand
                       : wet       ? static_cast<int>(random() % 17)
                                   : std::max(0, static_cast<int>(random() % 20) - 12);
        cell.stands = random() % 8 != 0;
        cell.on_water = random() % 3 != 0;
        cell.pressed = random() % 8 == 0;
        cell.cut = random() % 16 == 0;
    }
    return line;
}

TEST(WaterLines, conserve_water_and_leave_the_rest_alone) {
    std::mt19937 random(1);
    int changed = 0;
    for (int i = 0; i < 20000; ++i) {
        const Line before = random_line(random);
        Line line = before;
        const LineRule rule{.film = 1 + static_cast<int>(random() % 16),
                            .least = random() % 2 == 0 ? 0 : 8,
                            .rest_difference = 1 + static_cast<int>(random() % 2)};
        const bool told = level_line(line, rule, static_cast<std::uint32_t>(random()));
        ASSERT_EQ(total_of(line), total_of(before));
        for (std::size_t k = 0; k < line.size(); ++k) {
            if (is_open(before[k].content))
                ASSERT_TRUE(line[k].content >= 0 && is_open(line[k].content)) << line[k].content;
            else
                ASSERT_EQ(line[k].content, before[k].content);
        }
        const bool differs = contents_of(line) != contents_of(before);
        ASSERT_TRUE(told || !differs) << "a change that nobody is told of";
        changed += differs ? 1 : 0;
    }
    EXPECT_GT(changed, 5000);
}

TEST(WaterLines, level_to_within_one_quantum) {
    std::mt19937 random(2);
    for (int i = 0; i < 5000; ++i) {
        const bool on_water = random() % 2 == 0;
        std::vector<int> contents(1 + random() % 64);
        // Over ground at least a film everywhere.
        const int least = on_water ? 0 : axis.film;
        for (int& content : contents) content = least + static_cast<int>(random() % (17 - least));
        Line line = line_of(contents, on_water);
        level_line(line, axis, static_cast<std::uint32_t>(random()));
        ASSERT_LE(spread_of(line), 1);
    }
}

// Who gets the remainder changes from tick to tick, or water would creep one way.
TEST(WaterLines, remainders_fall_everywhere_alike) {
    constexpr int n = 7;
    std::vector<int> sum(n);
    for (std::uint32_t chance = 0; chance < 7000; ++chance) {
        Line line = line_of({16, 0, 0, 0, 0, 0, 1}, true);
        level_line(line, axis, chance);
        for (int i = 0; i < n; ++i) sum[i] += line[i].content;
    }
    for (const int quanta : sum) EXPECT_NEAR(quanta, 17000, 300);
}

TEST(WaterLines, rest_when_they_differ_by_no_more_than_the_rule_says) {
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        const LineRule rule{.film = 3, .least = i % 3 == 0 ? 8 : 0, .rest_difference = 1 + i % 2};
        std::vector<int> contents(1 + random() % 64);
        const int low = static_cast<int>(random() % (17 - rule.rest_difference));
        for (int& content : contents) content = low + static_cast<int>(random() % (rule.rest_difference + 1));
        Line line = line_of(contents, random() % 2 == 0);
        EXPECT_FALSE(level_line(line, rule, static_cast<std::uint32_t>(random())));
        EXPECT_EQ(contents_of(line), contents);
    }
}

TEST(WaterLines, films_hold_on_ground_and_spread_over_water) {
    const auto wet_cells = [](int quanta, bool on_water, const LineRule& rule, std::uint32_t chance) {
        Line line = line_of({0, 0, 0, 0, 0, 0, 0, 0, 0}, on_water);
        line[4].content = quanta;
        level_line(line, rule, chance);
        const auto contents = contents_of(line);
        EXPECT_LE(*std::max_element(contents.begin(), contents.end()), std::max(quanta, rule.film + 2));
        return std::count_if(contents.begin(), contents.end(), [](int content) { return content > 0; });
    };
    for (std::uint32_t chance = 0; chance < 100; ++chance)
        for (int quanta = 1; quanta <= 16; ++quanta)
            for (const int film : {1, 3, 5}) {
                const LineRule rule{.film = film, .least = 0, .rest_difference = 1};
                EXPECT_EQ(wet_cells(quanta, false, rule, chance), std::min(9, std::max(1, quanta / film)));
                EXPECT_EQ(wet_cells(quanta, true, rule, chance), quanta == 1 ? 1 : std::min(9, quanta));
            }
}

// Water over water beside water over ground: the former levels, whatever lies on the latter.
TEST(WaterLines, wide_rule_leaves_thin_films_over_ground) {
    for (std::uint32_t chance = 0; chance < 100; ++chance) {
        Line film = line_of({7, 7, 16, 3, 0, 0, 16, 14}, false);  // 63 quanta in 8 cells
        const auto before = contents_of(film);
        EXPECT_FALSE(level_line(film, wide, chance));
        EXPECT_EQ(contents_of(film), before);
        ++film[3].content;
        EXPECT_TRUE(level_line(film, wide, chance));
        EXPECT_EQ(spread_of(film), 0);

        Line mixed = line_of({16, 0, 0, 0, 16, 0, 0, 0}, true);
        for (int i = 4; i < 8; ++i) mixed[i].on_water = false;
        EXPECT_TRUE(level_line(mixed, wide, chance));
        EXPECT_EQ(contents_of(mixed), (std::vector<int>{4, 4, 4, 4, 16, 0, 0, 0}));

        // Nor does it feed a drop.
        Line shelf = line_of({5, 5, 5, 5, 0}, false);
        shelf[4].stands = false;
        EXPECT_FALSE(level_line(shelf, wide, chance));
        EXPECT_TRUE(level_line(shelf, axis, chance));
        EXPECT_EQ(shelf[4].content, 16);
    }
}

TEST(WaterLines, a_drop_takes_what_it_has_room_for) {
    std::mt19937 random(4);
    for (int i = 0; i < 5000; ++i) {
        const int n = 1 + static_cast<int>(random() % 30);
        std::vector<int> contents(n + 2);
        for (int& content : contents) content = static_cast<int>(random() % (random() % 2 == 0 ? 3 : 17));
        Line line = line_of(contents, random() % 2 == 0);
        line.front().stands = line.back().stands = false;
        const bool left = random() % 2 == 0;
        const bool right = random() % 2 == 0;
        if (!left) line.front().content = content_closed;
        if (!right) line[n].cut = true;
        const int quanta = std::accumulate(contents.begin() + 1, contents.end() - 1, 0);
        const int room_left = left ? 16 - contents.front() : 0;
        const int room_right = right ? 16 - contents.back() : 0;
        level_line(line, axis, static_cast<std::uint32_t>(random()));
        const int to_left = left ? line.front().content - contents.front() : 0;
        const int to_right = line.back().content - contents.back();
        ASSERT_TRUE(to_left >= 0 && to_left <= room_left && to_right >= 0 && to_right <= room_right);
        ASSERT_EQ(to_left + to_right, std::min(quanta, room_left + room_right));
        ASSERT_TRUE(to_left == room_left || to_right == room_right || std::abs(to_left - to_right) <= 1);
        const auto after = contents_of(line);
        if (room_left + room_right > 0) {
            const auto [low, high] = std::minmax_element(after.begin() + 1, after.end() - 1);
            ASSERT_LE(*high - *low, 1);
        }
    }
}

TEST(WaterLines, nothing_passes_a_cut_nor_leaves_pressed_water) {
    for (std::uint32_t chance = 0; chance < 100; ++chance) {
        Line cut = line_of({16, 8, 0, 0, 0, 0}, true);
        cut[2].cut = true;
        EXPECT_TRUE(level_line(cut, axis, chance));
        EXPECT_EQ(contents_of(cut), (std::vector<int>{8, 8, 8, 0, 0, 0}));

        Line pressed = line_of({16, 8, 0, 0}, true);
        for (LineCell& cell : pressed) cell.pressed = true;
        pressed[3].stands = false;
        const auto before = contents_of(pressed);
        EXPECT_FALSE(level_line(pressed, axis, chance));
        EXPECT_EQ(contents_of(pressed), before);
    }
}

}  // namespace
}  // namespace tarn::reference
