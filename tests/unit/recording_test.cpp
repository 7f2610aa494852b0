// Recordings: what is read, what is refused, the camera between keys, and the shipped ones.
#include "world/recording.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace tarn {
namespace {

std::string error_of(const std::string& text) {
    try {
        parse_recording(text, "r.json");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Recording, IsReadAndWrittenAlike) {
    const Recording recording = parse_recording(
        R"({"description": "d", "camera": "absolute", "frames": 3, "lead_frames": 2, "ticks_per_frame": [0, 1, 7],
            "keys": [{"frame": 0, "position_vox": [1, 2, 3], "yaw_deg": 10, "fov_deg": 40},
                     {"frame": 2, "position_vox": [3, 2, 3], "pitch_deg": -4, "fov_deg": 60}],
            "edits": [{"frame": 1, "center_vox": [4, 5, 6], "shape": "cube", "radius_vox": 2,
                       "material": "sand", "overwrite": true, "begins": true},
                      {"frame": 1, "stroke": "undo"}, {"frame": 2, "stroke": "redo"}]})",
        "some/r.json");
    EXPECT_EQ(recording.name, "r");
    EXPECT_FALSE(recording.relative);
    EXPECT_EQ(recording.ticks, (std::vector<int>{0, 1, 7}));
    EXPECT_EQ(recording.edits.at(0).edit.material, MATERIAL_SAND);
    EXPECT_EQ(recording.edits.at(0).edit.shape, BrushShape::Cube);
    EXPECT_TRUE(recording.edits.at(0).edit.overwrite);
    EXPECT_TRUE(recording.edits.at(0).begins);
    EXPECT_EQ(recording.edits.at(1).kind, RecordedEdit::Kind::Undo);
    EXPECT_EQ(recording.edits.at(2).kind, RecordedEdit::Kind::Redo);
    EXPECT_EQ(parse_recording(recording_json(recording), "r.json"), recording);
}

TEST(Recording, CamerasStandBeforeAndAfterTheKeysAndMoveStraightBetween) {
    const Recording recording = parse_recording(
        R"({"camera": "relative", "frames": 9,
            "keys": [{"frame": 0}, {"frame": 4, "position_vox": [8, 0, 4], "yaw_deg": 40},
                     {"frame": 6, "yaw_deg": 40}]})",
        "r.json");
    EXPECT_EQ(camera_at(recording, -3).position_vox, glm::vec3(0));
    EXPECT_EQ(camera_at(recording, 1).position_vox, glm::vec3(2, 0, 1));
    EXPECT_EQ(camera_at(recording, 1).yaw_deg, 10);
    EXPECT_EQ(camera_at(recording, 4).position_vox, glm::vec3(8, 0, 4));
    EXPECT_EQ(camera_at(recording, 5).position_vox, glm::vec3(4, 0, 2));
    EXPECT_EQ(camera_at(recording, 8).position_vox, glm::vec3(0));
}

TEST(Recording, RefusesWithThePlace) {
    const auto has = [](const std::string& text, const std::string& word) {
        const std::string error = error_of(text);
        EXPECT_NE(error.find(word), std::string::npos) << text << "\n" << error;
        EXPECT_EQ(error.find("r.json"), 0u) << error;
    };
    has("{", "not JSON");
    has(R"({"frames": 1, "keys": [{"frame": 0}]})", "camera: missing");
    has(R"({"camera": "free", "frames": 1, "keys": [{"frame": 0}]})", "relative, absolute");
    has(R"({"camera": "relative", "frames": 0, "keys": [{"frame": 0}]})", "frames");
    has(R"({"camera": "relative", "frames": 1, "keys": []})", "no key");
    has(R"({"camera": "relative", "frames": 9, "keys": [{"frame": 1}]})", "keys[0].frame");
    has(R"({"camera": "relative", "frames": 9, "keys": [{"frame": 0}, {"frame": 0}]})", "keys[1].frame");
    has(R"({"camera": "relative", "frames": 9, "keys": [{"frame": 0}, {"frame": 9}]})", "1 to 8");
    has(R"({"camera": "absolute", "frames": 9, "keys": [{"frame": 0}]})", "position_vox: missing");
    has(R"({"camera": "relative", "frames": 2, "ticks_per_frame": [1], "keys": [{"frame": 0}]})",
        "1 numbers");
    has(R"({"camera": "relative", "frames": 2, "keys": [{"frame": 0}], "speed": 1})", "speed: unknown key");
    for (const char* edit : {R"({"frame": 0, "center_vox": [0, 0, 0]})",
                             R"({"frame": 0, "center_vox": [0, 0, 0], "material": "cheese"})",
                             R"({"frame": 2, "center_vox": [0, 0, 0], "material": "air"})",
                             R"({"frame": 0, "center_vox": [0, 0, 1e9], "material": "air"})",
                             R"({"frame": 0, "center_vox": [0, 0, 0], "material": "air", "radius_vox": 257})",
                             R"({"frame": 0, "center_vox": [0, 0, 0], "material": "air", "overwrite": 1})"})
        has(fmt::format(R"({{"camera": "relative", "frames": 2, "keys": [{{"frame": 0}}], "edits": [{}]}})",
                        edit),
            "edits[0]");
}

TEST(Recording, ShippedOnesAreOfTheKindsTheyName) {
    EXPECT_EQ(builtin_recordings(), (std::vector<std::string>{"flying", "moving-water", "still"}));
    for (const std::string& name : builtin_recordings()) {
        const Recording recording = load_recording(name);
        EXPECT_EQ(recording.frames(), 24) << name;
        EXPECT_TRUE(recording.relative) << name;
        EXPECT_EQ(recording.moves_camera(), name == "flying") << name;
        EXPECT_EQ(recording.moves_world(), name == "moving-water") << name;
    }
    EXPECT_THROW(load_recording("walking"), Error);
}

}  // namespace
}  // namespace tarn
