// Errors and checks. Error: the environment, a file or a user's input is at fault; caught once, in main, exit
// code 2. CHECK: a bug in Tarn; prints the expression and aborts.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace tarn {

// The message names the thing, the reason and what is allowed, in one line.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(fmt::format(format, std::forward<Args>(args)...));
}

[[noreturn]] void check_failed(const char* expression, const char* file, int line, const std::string& why);

}  // namespace tarn

#define CHECK(expression)                                                             \
    do {                                                                              \
        if (!(expression)) ::tarn::check_failed(#expression, __FILE__, __LINE__, {}); \
    } while (false)

#define CHECK_MSG(expression, ...)                                                             \
    do {                                                                                       \
        if (!(expression))                                                                     \
            ::tarn::check_failed(#expression, __FILE__, __LINE__, ::fmt::format(__VA_ARGS__)); \
    } while (false)
