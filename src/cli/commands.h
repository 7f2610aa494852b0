// The command line: parses arguments and runs the subcommands.
#pragma once

namespace tarn {

// Returns the exit code; throws Error for bad input.
int run_command_line(int argc, char** argv);

}  // namespace tarn
