#include "core/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace tarn {

namespace fs = std::filesystem;

std::string read_text_file(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        fail("{}: cannot read: is a directory, a file is needed", path.string());
    std::ifstream file(path, std::ios::binary);
    if (!file) fail("{}: cannot read: {}", path.string(), std::strerror(errno));
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad()) fail("{}: cannot read: {}", path.string(), std::strerror(errno));
    return text;
}

void write_beside_and_rename(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    std::error_code ignored;
    // A device or a pipe is written, never replaced.
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) return write(path);
    // A link stays one: its target is replaced.
    const fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
    // The extension stays last: image writers choose the format by it.
    fs::path temporary = target;
    temporary.replace_filename(
        fmt::format(".{}.{}.part{}", path.stem().string(), getpid(), path.extension().string()));
    try {
        write(temporary);
        std::error_code error;
        fs::rename(temporary, target, error);
        if (error) fail("{}: cannot write: {}", path.string(), error.message());
    } catch (...) {
        fs::remove(temporary, ignored);
        throw;
    }
}

void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
    write_beside_and_rename(path, [&](const fs::path& temporary) {
        std::ofstream file(temporary, std::ios::binary);
        // The stream interface takes char; the bytes are the caller's.
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        file.flush();
        if (!file) fail("{}: cannot write: {}", path.string(), std::strerror(errno));
    });
}

void write_file(const fs::path& path, std::string_view text) {
    write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void check_writable(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        fail("{}: cannot write: is a directory, a file name is needed", path.string());
    const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(parent, ignored))
        fail("{}: cannot write: no folder {}", path.string(), parent.string());
    if (access(parent.c_str(), W_OK) != 0) fail("{}: cannot write: {}", path.string(), std::strerror(errno));
}

}  // namespace tarn
