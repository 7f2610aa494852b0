#include "core/error.h"

#include <cstdlib>

namespace tarn {

void check_failed(const char* expression, const char* file, int line, const std::string& why) {
    fmt::print(stderr, "tarn: bug: {}:{}: {}{}{}\n", file, line, expression, why.empty() ? "" : ": ", why);
    std::abort();
}

}  // namespace tarn
