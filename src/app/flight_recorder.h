// Records what the player does, frame by frame, as a recording that `tarn render --path` plays. Writes no
// file.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/settings.h"
#include "world/recording.h"

namespace tarn {

class FlightRecorder {
  public:
    bool is_on() const { return recording_.has_value(); }
    void start(const std::string& scene, std::uint64_t tick);
    // A frame as it was made: its camera, the edits before its ticks, how many of those. Nothing while off,
    // or once recording_frames_max frames are kept.
    // Centres are those of the `edit`s.
    void add_frame(const Settings& settings, const std::vector<RecordedEdit>& edits, int ticks);
    // What was recorded; nothing where no frame was.
    std::optional<Recording> stop();

  private:
    std::optional<Recording> recording_;
};

}  // namespace tarn
