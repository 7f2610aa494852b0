// What the player does, recorded, written, read and played again.
#include "app/flight_recorder.h"

#include <gtest/gtest.h>

#include "app/replay.h"

namespace tarn {
namespace {

TEST(FlightRecorder, PlaysBackTheCamerasEditsAndTicksOfEachFrame) {
    FlightRecorder recorder;
    Settings settings;
    recorder.add_frame(settings, {}, 3);  // off
    EXPECT_FALSE(recorder.stop());
    recorder.start("lake", 12);
    EXPECT_TRUE(recorder.is_on());
    std::vector<Settings> made;
    std::vector<Edit> edits;
    for (int frame = 0; frame < 5; ++frame) {
        settings.camera_position_vox = {1.5f * static_cast<float>(frame), 2.25f, -3.f};
        settings.camera_yaw_deg = frame < 3 ? 170 : -170;  // turns through the back
        settings.camera_pitch_deg = static_cast<float>(-frame);
        edits.push_back(
            {.tick = 99, .center_vox = {frame, -2, 7}, .radius_vox = 2, .material = MATERIAL_SAND});
        made.push_back(settings);
        recorder.add_frame(settings, {{.edit = edits.back(), .begins = frame == 2}}, frame);
    }
    const auto recorded = recorder.stop();
    EXPECT_FALSE(recorder.is_on());
    ASSERT_TRUE(recorded);
    const Recording read = parse_recording(recording_json(*recorded), "flight.json");
    EXPECT_EQ(read.description, "Recorded in lake from tick 12");
    EXPECT_EQ(read.ticks, (std::vector<int>{0, 1, 2, 3, 4}));
    Settings elsewhere;
    elsewhere.camera_position_vox = {9, 9, 9};
    for (int frame = 0; frame < 5; ++frame) {
        Settings played = elsewhere;
        place_camera(read, frame, elsewhere, played);
        EXPECT_EQ(played.camera_position_vox, made[frame].camera_position_vox);
        EXPECT_EQ(played.camera_yaw_deg, made[frame].camera_yaw_deg);
        EXPECT_EQ(played.camera_pitch_deg, made[frame].camera_pitch_deg);
        Edit expected = edits[frame];
        expected.tick = 5;
        const auto played_edits = edits_of(read, frame, elsewhere, 5);
        ASSERT_EQ(played_edits.size(), 1u);
        EXPECT_EQ(played_edits[0].edit, expected);
        EXPECT_EQ(played_edits[0].begins, frame == 2);
    }
}

}  // namespace
}  // namespace tarn
