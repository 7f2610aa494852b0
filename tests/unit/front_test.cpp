// The front: its file, the slider's positions, and what the setting `tradeoff` does.
#include "core/front.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace tarn {
namespace {

TEST(Front, TheShippedOneGoesFromFastToAccurate) {
    const auto points = front();
    ASSERT_GE(points.size(), 3u);
    for (std::size_t i = 1; i < points.size(); ++i) {
        EXPECT_GT(points[i].time, points[i - 1].time);
        EXPECT_LT(points[i].error, points[i - 1].error);
    }
}

TEST(Front, EachPointIsFoundAgainAndTheSliderStandsThere) {
    for (std::size_t i = 0; i < front().size(); ++i) {
        Settings settings;
        apply_quality(settings, Quality::Exact);
        set_setting(settings, "tradeoff", fmt::format("{}", front_position(i)));
        EXPECT_EQ(point_of(settings), i);
        EXPECT_EQ(front_point(settings.tradeoff), i);
        EXPECT_EQ(settings.quality, front()[i].quality);
    }
}

TEST(Front, PositionsBetweenPointsCountAsTheNearest) {
    const std::size_t last = front().size() - 1;
    EXPECT_EQ(front_point(-1), 0u);
    EXPECT_EQ(front_point(2), last);
    EXPECT_EQ(front_point(0.4 / static_cast<double>(last)), 0u);
    EXPECT_EQ(front_point(0.6 / static_cast<double>(last)), 1u);
    Settings settings;
    set_setting(settings, "tradeoff", fmt::format("{}", 0.6 / static_cast<double>(last)));
    EXPECT_EQ(point_of(settings), 1u);
}

TEST(Front, AChangedSettingLeavesTheFront) {
    Settings settings;
    set_setting(settings, "tradeoff", "0");
    set_setting(settings, "max_bounces", "77");
    EXPECT_FALSE(point_of(settings));
    // The camera is no part of it.
    set_setting(settings, "tradeoff", "0");
    set_setting(settings, "camera_yaw_deg", "77");
    EXPECT_EQ(point_of(settings), 0u);
}

TEST(Front, AQualityMovesTheSliderToWhereItLies) {
    for (const Quality quality : {Quality::Fast, Quality::Balanced, Quality::Quality}) {
        Settings settings;
        apply_quality(settings, quality);
        if (const auto point = point_of(settings)) {
            EXPECT_EQ(front_point(settings.tradeoff), *point);
        }
    }
}

TEST(Front, IsReadAndWrittenAlike) {
    const std::vector<FrontPoint> points = {{Quality::Fast, {"history_cap=9", "max_bounces=3"}, 0.25, 0.5},
                                            {Quality::Balanced, {}, 1, 0.125}};
    const auto read = parse_front(front_json(points, "a test"), "f.json");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].set, points[0].set);
    EXPECT_EQ(front_label(read[0]), "fast history_cap=9 max_bounces=3");
    EXPECT_EQ(front_label(read[1]), "balanced");
    EXPECT_EQ(read[1].error, 0.125);
}

TEST(Front, RefusesWhatIsNone) {
    const auto refused = [](const std::string& text) {
        try {
            parse_front(text, "f.json");
        } catch (const Error& error) {
            return std::string(error.what()).find("f.json") == 0 ||
                   text.find("max_bounces") != std::string::npos;
        }
        return false;
    };
    const auto point = [](const char* set, double time, double error) {
        return fmt::format(R"({{"quality": "fast", "set": [{}], "time": {}, "error": {}}})", set, time,
                           error);
    };
    EXPECT_TRUE(refused("{"));
    EXPECT_TRUE(refused("[]"));
    EXPECT_TRUE(refused(R"({"points": []})"));
    EXPECT_TRUE(refused(R"({"points": [{"quality": "best", "set": [], "time": 1, "error": 1}]})"));
    EXPECT_TRUE(refused(fmt::format(R"({{"points": [{}]}})", point("", 0, 1))));
    EXPECT_TRUE(refused(fmt::format(R"({{"points": [{}, {}]}})", point("", 2, 1), point("", 1, 0.5))));
    EXPECT_TRUE(refused(fmt::format(R"({{"points": [{}, {}]}})", point("", 1, 1), point("", 2, 1))));
    EXPECT_TRUE(refused(fmt::format(R"({{"points": [{}]}})", point("\"camera_yaw_deg=3\"", 1, 1))));
    EXPECT_TRUE(refused(fmt::format(R"({{"points": [{}]}})", point("\"tradeoff=1\"", 1, 1))));
    EXPECT_TRUE(refused(fmt::format(R"({{"points": [{}]}})", point("\"max_bounces=-1\"", 1, 1))));
    EXPECT_FALSE(refused(fmt::format(R"({{"points": [{}]}})", point("\"max_bounces=1\"", 1, 1))));
}

}  // namespace
}  // namespace tarn
