// The governor under scripted loads: noise, spikes, steps, a table that is wrong, targets out of reach.
#include "app/governor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "app/frame_times.h"

namespace tarn {
namespace {

const std::vector<double> table = {0.2, 0.35, 0.6, 1, 1.6, 2.5, 4};

struct Script {
    double target_ms = 33;
    std::function<double(int)> load_ms;  // of a frame at time 1, by frame
    std::vector<double> truth = table;   // of this scene; the governor knows `table`
    double noise = 0;                    // standard deviation of a frame's time, relative
    double spike_share = 0;              // of frames that take ten times as long
    std::size_t start = 3;
};

struct Outcome {
    std::vector<std::size_t> points;  // by frame
    std::vector<double> ms;           // without noise
    int switches(int from, int to) const {
        int n = 0;
        for (int i = from + 1; i < to; ++i) n += points[i] != points[i - 1] ? 1 : 0;
        return n;
    }
};

Outcome run(const Script& script, int frames) {
    Governor governor(table);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    Outcome outcome;
    std::size_t point = script.start;
    for (int frame = 0; frame < frames; ++frame) {
        const double clean = script.load_ms(frame) * script.truth[point];
        double ms = clean * std::max(0.2, 1 + script.noise * normal(random));
        if (uniform(random) < script.spike_share) ms *= 10;
        outcome.points.push_back(point);
        outcome.ms.push_back(clean);
        point = governor.frame(ms, point, script.target_ms);
    }
    return outcome;
}

TEST(Governor, ClimbsToTheBestPointThatFitsAndStays) {
    const Outcome outcome = run({.load_ms = [](int) { return 18.0; }, .start = 0}, 1000);
    EXPECT_EQ(outcome.points.back(), 3u);  // 18 ms; the next would take 28.8, above 0.85 of the target
    EXPECT_EQ(outcome.switches(300, 1000), 0);
}

TEST(Governor, FallsWithinFiveFramesAndOnAsFarAsNeeded) {
    const Outcome outcome = run({.load_ms = [](int frame) { return frame < 200 ? 30.0 : 120.0; }}, 400);
    EXPECT_EQ(outcome.points[199], 3u);
    EXPECT_EQ(outcome.points[204], 3u);
    EXPECT_LT(outcome.points[205], 3u);
    EXPECT_GT(outcome.points[205], 0u) << "at first no further than the load of five frames is worth";
    EXPECT_EQ(outcome.points[225], 0u);  // 24 ms; the next would take 42
    EXPECT_LE(outcome.switches(200, 400), 3);
}

TEST(Governor, SpikesOfUpToFourFramesMoveNothing) {
    for (const int spike : {1, 2, 4})
        for (const double times : {2.0, 10.0, 100.0}) {
            const Outcome outcome =
                run({.load_ms = [&](int frame) { return frame % 300 >= 300 - spike ? 28.0 * times : 28.0; }},
                    3000);
            EXPECT_EQ(outcome.switches(0, 3000), 0) << spike << " frames, " << times << " times";
        }
}

TEST(Governor, ASpikeThatLastsCostsOneFallAndNoMoreThanHalfASecondAfterIt) {
    // A second of something else on the machine, however heavy.
    for (const double times : {3.0, 30.0}) {
        const Outcome outcome = run(
            {.load_ms = [&](int frame) { return frame >= 200 && frame < 208 ? 28.0 * times : 28.0; }}, 2000);
        EXPECT_EQ(outcome.switches(200, 208), 1);
        for (int frame = 200; frame < 240; ++frame) EXPECT_GE(outcome.points[frame], 2u) << frame;
        EXPECT_EQ(outcome.points[240], 3u) << times;
        EXPECT_EQ(outcome.switches(240, 2000), 0);
    }
}

TEST(Governor, WhatASpikeTaughtIsForgotten) {
    // The load leaves in the very frame of the fall: the lower point seems thirty times cheaper.
    const Outcome outcome =
        run({.load_ms = [](int frame) { return frame >= 200 && frame < 205 ? 900.0 : 28.0; }}, 2000);
    EXPECT_EQ(outcome.points[300], 3u);
    EXPECT_EQ(outcome.switches(300, 2000), 0);
}

TEST(Governor, ExpectsThatOnlyThePictureScales) {
    Governor governor(table);
    // 20 ms, of which 15 are ticks and panels.
    for (int i = 0; i < 40; ++i) governor.frame(20, 3, 0, 15);
    EXPECT_DOUBLE_EQ(governor.expected_ms(3), 20);
    EXPECT_DOUBLE_EQ(governor.expected_ms(0), 16);
    EXPECT_DOUBLE_EQ(governor.expected_ms(6), 35);
    // Right after the move that is what it says; mended by the frames, the first that count.
    governor.frame(90, 6, 0, 15);
    EXPECT_DOUBLE_EQ(governor.expected_ms(6), 35);
    for (int i = 0; i < Governor::settle_frames + Governor::frames_known - 1; ++i)
        governor.frame(45, 6, 0, 15);
    EXPECT_DOUBLE_EQ(governor.expected_ms(6), 45);
    for (int i = 0; i < 20; ++i) governor.frame(45, 6, 0, 15);
    EXPECT_NEAR(governor.expected_ms(3), 20, 0.01);
    // More fixed than there is counts as all.
    for (int i = 0; i < 20; ++i) governor.frame(45, 6, 0, 1e9);
    EXPECT_DOUBLE_EQ(governor.expected_ms(0), 45);
}

// Point 3 takes 20 ms, of which 15 are fixed; what the picture took is told three frames late.
TEST(Governor, LearnsTheTruthFromPictureTimesThatLag) {
    constexpr long lag = 3;
    Governor governor(table);
    FrameTimes times;
    std::vector<double> picture_ms;
    const auto run_at = [&](std::size_t point, int frames) {
        for (int i = 0; i < frames; ++i) {
            const auto frame = static_cast<long>(picture_ms.size());
            picture_ms.push_back(5 * table[point]);
            times.add_frame(frame, 15 + picture_ms.back());
            if (frame < lag) {
                EXPECT_EQ(times.fixed_ms(), 0);
            } else {
                times.add_picture(frame - lag, picture_ms[static_cast<std::size_t>(frame - lag)]);
                EXPECT_DOUBLE_EQ(times.fixed_ms(), 15) << frame;
            }
            governor.frame(15 + picture_ms.back(), point, 0, times.fixed_ms());
        }
    };
    run_at(3, 40);
    for (const std::size_t point : {6, 0, 5, 3}) {
        run_at(point, 20);
        for (std::size_t other = 0; other < table.size(); ++other)
            EXPECT_NEAR(governor.expected_ms(other), 15 + 5 * table[other], 0.01) << point << ' ' << other;
    }
}

TEST(FrameTimes, KnowOnlyWhatTheyWereTold) {
    FrameTimes times;
    EXPECT_EQ(times.fixed_ms(), 0);
    times.add_picture(-1, 3);
    times.add_frame(0, 10);
    times.add_picture(7, 3);  // a frame that is not known
    EXPECT_EQ(times.fixed_ms(), 0);
    times.add_frame(8, 10);
    times.add_picture(8, 4);
    times.add_picture(8, 9);  // twice
    EXPECT_EQ(times.fixed_ms(), 6);
    for (long frame = 9; frame < 13; ++frame) {
        times.add_frame(frame, 10);
        times.add_picture(frame, frame == 10 ? 30 : 4);  // one that overlapped another
    }
    EXPECT_EQ(times.fixed_ms(), 6);
    for (long frame = 13; frame < 100; ++frame) times.add_frame(frame, 10);
    times.add_picture(13, 0);  // too late
    EXPECT_EQ(times.fixed_ms(), 6);
}

// The last nine frames are slower than the thirty, and all of it is said to be fixed.
TEST(Governor, ExpectsNoLessOfADearerPoint) {
    Governor governor(table);
    for (int i = 0; i < Governor::settle_frames + Governor::frames_kept; ++i)
        EXPECT_EQ(governor.frame(i < Governor::settle_frames + 21 ? 20 : 24, 3, 22, 24), 3u);
    EXPECT_DOUBLE_EQ(governor.expected_ms(3), 20);
    for (std::size_t point = 1; point < table.size(); ++point)
        EXPECT_GE(governor.expected_ms(point), governor.expected_ms(point - 1)) << point;
}

TEST(Governor, DoesNotSwingUnderNoiseAndSpikes) {
    for (const double load : {8.0, 13.0, 20.0, 27.0, 29.0, 31.0, 33.0, 35.0, 37.0, 55.0, 90.0}) {
        const Outcome outcome =
            run({.load_ms = [&](int) { return load; }, .noise = 0.2, .spike_share = 0.05}, 4000);
        EXPECT_LE(outcome.switches(1000, 4000), 2) << load;
        const double best = outcome.ms.back();
        EXPECT_LE(best, 1.15 * 33) << load;
    }
}

TEST(Governor, LearnsWhatATableFromElsewhereHasWrong) {
    // Here the point above costs five times as much, not 1.6 times.
    std::vector<double> truth = table;
    for (std::size_t i = 4; i < truth.size(); ++i) truth[i] *= 3;
    const Outcome outcome = run({.load_ms = [](int) { return 15.0; }, .truth = truth}, 6000);
    EXPECT_EQ(outcome.points.back(), 3u);
    EXPECT_LE(outcome.switches(0, 6000), 2);  // up once, and back for good
}

TEST(Governor, FollowsStepsBothWays) {
    const Outcome outcome =
        run({.load_ms = [](int frame) { return frame / 500 % 2 == 0 ? 16.0 : 64.0; }, .noise = 0.1}, 4000);
    // Down within a few frames of each step up; at most four moves to climb back.
    for (int step = 500; step + 500 <= 4000; step += 1000) {
        EXPECT_LE(outcome.ms[step + 30], 33 * 1.1) << step;
        EXPECT_LE(outcome.switches(step, step + 500), 2) << step;
        EXPECT_LE(outcome.switches(step + 500, std::min(step + 1000, 4000)), 4) << step;
    }
}

TEST(Governor, LosesPatienceWithALoadThatComesAndGoes) {
    // Every move up is taken back some frames later; no table could know.
    const Outcome outcome =
        run({.load_ms = [](int frame) { return frame / 80 % 2 == 0 ? 20.0 : 40.0; }}, 12000);
    EXPECT_GT(outcome.switches(0, 1000), 4);
    EXPECT_LE(outcome.switches(8000, 12000), 8);
}

TEST(Governor, TargetsOutOfReachEndAtTheEnds) {
    const Outcome slow = run({.target_ms = 1, .load_ms = [](int) { return 50.0; }, .noise = 0.1}, 2000);
    EXPECT_EQ(slow.points.back(), 0u);
    EXPECT_EQ(slow.switches(100, 2000), 0);
    const Outcome fast = run({.target_ms = 10000, .load_ms = [](int) { return 5.0; }, .noise = 0.1}, 2000);
    EXPECT_EQ(fast.points.back(), table.size() - 1);
    EXPECT_EQ(fast.switches(1000, 2000), 0);
}

TEST(Governor, WatchesWithoutATargetAndSaysWhatToExpect) {
    Governor governor(table);
    EXPECT_EQ(governor.expected_ms(3), 0);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(governor.frame(20, 3, 0), 3u);
    EXPECT_DOUBLE_EQ(governor.expected_ms(3), 20);
    EXPECT_DOUBLE_EQ(governor.expected_ms(0), 4);
    // The player moves the slider: what to expect there is known at once, and corrected when it was seen.
    governor.frame(20, 5, 0);
    EXPECT_DOUBLE_EQ(governor.expected_ms(5), 50);
    for (int i = 0; i < 100; ++i) governor.frame(70, 5, 0);
    EXPECT_DOUBLE_EQ(governor.expected_ms(5), 70);
    EXPECT_NEAR(governor.expected_ms(3), 20, 0.1);
}

TEST(Governor, IgnoresTimesOfNoSense) {
    Governor governor(table);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double ms : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
        for (int i = 0; i < 50; ++i) EXPECT_EQ(governor.frame(ms, 3, 33), 3u);
    EXPECT_EQ(governor.expected_ms(3), 0);
    EXPECT_LT(governor.frame(20, 99, 33), table.size());
}

}  // namespace
}  // namespace tarn
