// What a view shows and what its colours mean, drawn over it. Takes no input.
#pragma once
#include "core/settings.h"

namespace tarn {

// Top right; `view` is any but the picture.
void draw_legend(ViewKind view);

}  // namespace tarn
