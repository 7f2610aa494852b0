// A recording: how the camera moves and what happens to the world over some frames, for any scene. Documented
// for users in `tarn render --help` and the README. Plain data; app/replay.h plays it.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "world/edits.h"

namespace tarn {

// Relative recordings: right, up and ahead of the scene's own camera, and turns from it. Absolute: as
// settings.
struct CameraKey {
    int frame = 0;
    glm::vec3 position_vox{0};
    float yaw_deg = 0, pitch_deg = 0;
    float fov_deg = 0;  // 0: the scene's
    bool operator==(const CameraKey&) const = default;
};

struct RecordedEdit {
    enum class Kind { Edit, Undo, Redo };
    int frame = 0;  // applied before its ticks
    glm::vec3 center_vox{0};
    Edit edit = {};       // but for tick and centre
    bool begins = false;  // a stroke, which the edits after it go on with
    Kind kind = Kind::Edit;
    bool operator==(const RecordedEdit&) const = default;
};

struct Recording {
    std::string name, description;
    bool relative = true;
    int lead_frames = 0;          // shown by the first frame's camera before it, without ticks: history grows
    std::vector<int> ticks;       // before each frame; its size is the count of frames
    std::vector<CameraKey> keys;  // in order of frames, the first at 0; straight between them
    std::vector<RecordedEdit> edits;  // in order of frames

    int frames() const { return static_cast<int>(ticks.size()); }
    bool moves_world() const;
    bool moves_camera() const;
    bool operator==(const Recording&) const = default;
};

constexpr int recording_frames_max = 100000;

// A built-in recording by name, or a file (a name with '/' or ending in .json). Throws Error naming file,
// place and reason.
Recording load_recording(const std::string& name_or_path);
Recording parse_recording(const std::string& text, const std::string& origin);
std::vector<std::string> builtin_recordings();

// As parse_recording reads it.
std::string recording_json(const Recording& recording);

// The camera of a frame, between the keys around it; before the first and after the last it stands.
CameraKey camera_at(const Recording& recording, int frame);

}  // namespace tarn
