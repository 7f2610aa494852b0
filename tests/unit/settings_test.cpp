#include "core/settings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace tarn {
namespace {

std::string error_of_assignment(const std::string& assignment) {
    Settings settings;
    try {
        set_assignment(settings, assignment);
    } catch (const Error& error) {
        EXPECT_EQ(settings, Settings{}) << "a refused value must change nothing";
        return error.what();
    }
    return "";
}

TEST(Settings, EveryDefaultLiesInItsRangeAndReadsBack) {
    const Settings defaults;
    for (const SettingInfo& info : setting_infos()) {
        Settings copy;
        info.set(copy, glm::dvec3(info.max));
        set_setting(copy, info.name, setting_text(defaults, info));
        EXPECT_EQ(info.get(copy), info.get(defaults)) << info.name;
        EXPECT_GT(std::string(info.help).size(), 10u) << info.name;
    }
}

TEST(Settings, BadValuesNameTheKeyTheReasonAndTheRange) {
    EXPECT_EQ(error_of_assignment("max_bounces=-3"),
              "setting max_bounces=-3: out of range; allowed: a whole number from 0 to 1024");
    EXPECT_NE(error_of_assignment("max_bounces=1.5").find("not a whole number"), std::string::npos);
    EXPECT_NE(error_of_assignment("exposure_ev=nan").find("not a finite number"), std::string::npos);
    EXPECT_NE(error_of_assignment("exposure_ev=inf").find("not a finite number"), std::string::npos);
    EXPECT_NE(error_of_assignment("exposure_ev=").find("not a finite number"), std::string::npos);
    EXPECT_NE(error_of_assignment("quality=best").find("baseline, fast, balanced, quality, exact"),
              std::string::npos);
    EXPECT_NE(error_of_assignment("water_color=1,1").find("three numbers"), std::string::npos);
    EXPECT_NE(error_of_assignment("water_color=1,1,1,1").find("allowed"), std::string::npos);
    EXPECT_NE(error_of_assignment("water_color=0,1,1").find("out of range"), std::string::npos);
    EXPECT_NE(error_of_assignment("wetness=1").find("no such setting"), std::string::npos);
    EXPECT_NE(error_of_assignment("max_bounces").find("key=value"), std::string::npos);
}

TEST(Settings, AQualityPresetSetsWhatItNamesAndPresetsDiffer) {
    for (int a = 0; a < 5; ++a) {
        Settings one;
        apply_quality(one, static_cast<Quality>(a));
        EXPECT_EQ(one.quality, static_cast<Quality>(a));
        for (int b = 0; b < a; ++b) {
            Settings other;
            apply_quality(other, static_cast<Quality>(b));
            other.quality = one.quality;
            EXPECT_NE(one, other) << "presets " << a << " and " << b << " differ by name only";
        }
    }
}

TEST(Settings, TheQualityChosenLastCountsAlone) {
    for (int a = 0; a < 5; ++a) {
        for (int b = 0; b < 5; ++b) {
            Settings direct;
            apply_quality(direct, static_cast<Quality>(b));
            Settings after;
            apply_quality(after, static_cast<Quality>(a));
            apply_quality(after, static_cast<Quality>(b));
            EXPECT_EQ(after, direct) << a << " then " << b;
        }
    }
}

TEST(Settings, DifferenceTellsWhatAChangeAsksFor) {
    Settings a;
    Settings b;
    EXPECT_EQ(difference(a, b), SettingEffect::NONE);
    b.exposure_ev = 1;
    EXPECT_EQ(difference(a, b), SettingEffect::NONE);
    b.max_bounces = 1;
    EXPECT_EQ(difference(a, b), SettingEffect::IMAGE);
    b.resolution_scale = 0.5f;
    EXPECT_EQ(difference(a, b), SettingEffect::TARGETS);
}

TEST(Settings, JsonHoldsEverySetting) {
    const auto json = nlohmann::json::parse(settings_json(Settings{}));
    EXPECT_EQ(json.size(), setting_infos().size());
    EXPECT_EQ(json["water_tier"], "level");
    EXPECT_EQ(json["max_bounces"], 24);
}

}  // namespace
}  // namespace tarn
