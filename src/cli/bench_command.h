// `tarn bench`: what rays, frames, ticks, edits and starts cost.
#pragma once
#include "cli/arguments.h"

namespace tarn {

// Names of the suites.
const std::vector<std::string>& bench_suites();

// 1 where contestants do not find the same, so that their times mean nothing, else 0. Throws Error on bad
// names.
int run_bench_command(const Arguments& arguments);

}  // namespace tarn
