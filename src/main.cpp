// Settings -> Platform -> App; the only catch.
#include <fmt/format.h>

#include <exception>

#include "cli/commands.h"

int main(int argc, char** argv) {
    try {
        return tarn::run_command_line(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "tarn: {}\n", error.what());
        return 2;
    }
}
