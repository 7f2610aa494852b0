// `tarn tradeoff`: measures what speed costs in accuracy.
#pragma once
#include "cli/arguments.h"

namespace tarn {

// The exit code: 1 where a sample was not finite. Throws Error for bad input.
int run_tradeoff_command(const Arguments& arguments);

// Names for --part and --scene.
const std::vector<std::string>& tradeoff_parts();
std::vector<std::string> tradeoff_scenes();

}  // namespace tarn
