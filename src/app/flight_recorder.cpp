#include "app/flight_recorder.h"

#include <fmt/format.h>

#include <utility>

namespace tarn {

void FlightRecorder::start(const std::string& scene, std::uint64_t tick) {
    recording_.emplace();
    recording_->relative = false;
    recording_->description = fmt::format("Recorded in {} from tick {}", scene, tick);
}

void FlightRecorder::add_frame(const Settings& settings, const std::vector<RecordedEdit>& edits, int ticks) {
    if (!recording_ || recording_->frames() >= recording_frames_max) return;
    const int frame = recording_->frames();
    recording_->ticks.push_back(ticks);
    recording_->keys.push_back({.frame = frame,
                                .position_vox = settings.camera_position_vox,
                                .yaw_deg = settings.camera_yaw_deg,
                                .pitch_deg = settings.camera_pitch_deg,
                                .fov_deg = settings.camera_fov_deg});
    for (const RecordedEdit& edit : edits) {
        RecordedEdit& recorded = recording_->edits.emplace_back(edit);
        recorded.frame = frame;
        recorded.center_vox = glm::vec3(std::exchange(recorded.edit.center_vox, glm::ivec3(0)));
        recorded.edit.tick = 0;
    }
}

std::optional<Recording> FlightRecorder::stop() {
    std::optional<Recording> recording = std::exchange(recording_, std::nullopt);
    if (recording && recording->ticks.empty()) recording.reset();
    return recording;
}

}  // namespace tarn
