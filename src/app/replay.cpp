#include "app/replay.h"

#include <algorithm>
#include <cmath>

#include "app/camera.h"
#include "app/undo.h"

namespace tarn {

namespace {

// From right, up, ahead of the scene's camera to the world.
glm::vec3 world_from_start(const Settings& start, glm::vec3 at) {
    const CameraBasis basis = camera_basis(start.camera_yaw_deg, start.camera_pitch_deg);
    return start.camera_position_vox + at.x * basis.right + at.y * basis.up + at.z * basis.dir;
}

}  // namespace

void place_camera(const Recording& recording, int frame, const Settings& start, Settings& settings) {
    const CameraKey key = camera_at(recording, frame);
    settings.camera_position_vox =
        recording.relative ? world_from_start(start, key.position_vox) : key.position_vox;
    const float yaw = key.yaw_deg + (recording.relative ? start.camera_yaw_deg : 0);
    const float pitch = key.pitch_deg + (recording.relative ? start.camera_pitch_deg : 0);
    settings.camera_yaw_deg = std::remainder(yaw, 360.f);
    settings.camera_pitch_deg = std::clamp(pitch, -90.f, 90.f);
    settings.camera_fov_deg = key.fov_deg > 0 ? key.fov_deg : start.camera_fov_deg;
}

std::vector<RecordedEdit> edits_of(const Recording& recording, int frame, const Settings& start,
                                   std::uint64_t tick) {
    std::vector<RecordedEdit> edits;
    for (const RecordedEdit& recorded : recording.edits) {
        if (recorded.frame != frame) continue;
        RecordedEdit& made = edits.emplace_back(recorded);
        const glm::vec3 center =
            recording.relative ? world_from_start(start, recorded.center_vox) : recorded.center_vox;
        made.edit.center_vox = glm::ivec3(glm::floor(center));
        made.edit.tick = tick;
    }
    return edits;
}

void play_world(const Recording& recording, int frame, const Settings& start, Simulation& simulation,
                const Settings& settings, EditHistory& history) {
    for (const RecordedEdit& made : edits_of(recording, frame, start, simulation.tick())) {
        if (made.kind == RecordedEdit::Kind::Undo) {
            undo_stroke(simulation, history);
        } else if (made.kind == RecordedEdit::Kind::Redo) {
            redo_stroke(simulation, history);
        } else {
            if (made.begins) history.begin_stroke();
            simulation.apply(made.edit, history);
        }
    }
    simulation.step(recording.ticks[static_cast<std::size_t>(frame)], settings);
}

}  // namespace tarn
