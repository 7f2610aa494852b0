// `tarn light`: measures the ways of finding light.
#pragma once
#include "cli/arguments.h"

namespace tarn {

// The exit code: 1 where a mean is off by more than four standard errors, or a sample was not finite.
int run_light_command(const Arguments& arguments);

}  // namespace tarn
