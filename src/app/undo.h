// Undo and redo of strokes in a running world, where what was poured has flowed on.
#pragma once
#include "app/simulation.h"
#include "world/edits.h"

namespace tarn {

// Takes back the last stroke: its cells as they were before it, and as much water and sand around as it
// placed more than those held. Both return whether there was a stroke; they wait for the GPU.
bool undo_stroke(Simulation& simulation, EditHistory& history);
bool redo_stroke(Simulation& simulation, EditHistory& history);

}  // namespace tarn
