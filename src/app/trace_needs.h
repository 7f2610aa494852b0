// What the trace program must be able to do for a picture: decided by what the world may hold and by
// settings.
#pragma once
#include <functional>

#include "core/settings.h"
#include "passes/trace_pass.h"
#include "shared/frame.h"
#include "world/material_table.h"

namespace tarn {

// `block`: of the frame. may_hold(id): whether the world may hold voxels of that material by now.
TraceFeatures needed_features(const Settings& settings, const MaterialTable& materials,
                              const FrameBlock& block, const std::function<bool(std::size_t id)>& may_hold);

// The most that a picture under these settings can come to need: a player may place any material of the table
// and turn the hours of the day.
TraceFeatures general_features(const Settings& settings, const MaterialTable& materials);

// All that one of them does.
TraceFeatures with(const TraceFeatures& a, const TraceFeatures& b);

}  // namespace tarn
