// `tarn water`: the scenarios of water, measured.
#pragma once
#include "cli/arguments.h"

namespace tarn {

// 1 where water or sand was lost or made in any run, else 0. Throws Error on names that do not exist.
int run_water_command(const Arguments& arguments);

}  // namespace tarn
