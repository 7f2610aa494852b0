#include "bench/child.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "app/stopwatch.h"
#include "core/error.h"

namespace tarn {

namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> list;
    list.reserve(texts.size() + 1);
    for (std::string& text : texts) list.push_back(text.data());
    list.push_back(nullptr);
    return list;
}

constexpr useconds_t poll_us = 2000;

// Most that a running process has held so far; 0 where it has ended.
double peak_mib_of(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/status", process));
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("VmHWM:")) return std::strtod(line.c_str() + 6, nullptr) / 1024;
    return 0;
}

}  // namespace

ChildRun run_self(const std::vector<std::string>& arguments,
                  const std::vector<std::pair<std::string, std::string>>& environment) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe");
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> variables;
    variables.reserve(environment.size());
    for (const auto& [name, value] : environment) variables.push_back(fmt::format("{}={}", name, value));
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string text = *variable;
        const std::string name = text.substr(0, text.find('='));
        const bool replaced = std::any_of(environment.begin(), environment.end(),
                                          [&](const auto& pair) { return pair.first == name; });
        if (!replaced) variables.push_back(text);
    }

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const Stopwatch watch;
    const int error = posix_spawn(&child, program.c_str(), &actions, nullptr, pointers(words).data(),
                                  pointers(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) fail("cannot run {}: {}", program, std::strerror(error));
    // Not wait4's ru_maxrss: that begins at what this program held when it spawned the child.
    double peak_mib = 0;
    int status = 0;
    pid_t ended = 0;
    while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
        peak_mib = std::max(peak_mib, peak_mib_of(child));
        usleep(poll_us);
    }
    const double wall_s = watch.ms() / 1e3;
    if (ended != child) fail("cannot wait for {}", program);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail("tarn {} ended with status {}", fmt::join(arguments, " "), status);
    return {.wall_s = wall_s, .peak_mib = peak_mib};
}

TemporaryFolder::TemporaryFolder() {
    path_ = std::filesystem::temp_directory_path() / "tarn-bench-XXXXXX";
    if (mkdtemp(path_.data()) == nullptr) fail("{}: cannot make the folder: {}", path_, std::strerror(errno));
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace tarn
