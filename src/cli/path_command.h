// `tarn render --path`: the frames of a recording as pictures.
#pragma once
#include <glm/glm.hpp>

#include "cli/arguments.h"

namespace tarn {

// The exit code. Throws Error for bad input.
int render_path(const Arguments& arguments, glm::ivec2 size_px);

}  // namespace tarn
