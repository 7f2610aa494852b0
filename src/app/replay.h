// Plays a recording on a simulation: the camera, edits and ticks of each frame. Draws nothing.
#pragma once
#include "app/simulation.h"
#include "core/settings.h"
#include "world/recording.h"

namespace tarn {

// `start`: settings with the scene's own camera. Frames before 0 stand at the first one.
void place_camera(const Recording& recording, int frame, const Settings& start, Settings& settings);

// The edits of a frame, `edit` at cells of the world.
std::vector<RecordedEdit> edits_of(const Recording& recording, int frame, const Settings& start,
                                   std::uint64_t tick);

// Edits, then ticks, of frames 0 and after in order; `history`: of the frames before.
void play_world(const Recording& recording, int frame, const Settings& start, Simulation& simulation,
                const Settings& settings, EditHistory& history);

}  // namespace tarn
