// Reading and writing whole files. Writes go beside the target and are renamed, so a failure loses nothing.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace tarn {

// Throws Error naming the file and the system's reason.
std::string read_text_file(const std::filesystem::path& path);

// Calls `write(temporary)`, then renames the temporary over `path`; removes it if `write` throws. Where
// `path` is a device or a pipe: `write(path)`.
void write_beside_and_rename(const std::filesystem::path& path,
                             const std::function<void(const std::filesystem::path&)>& write);

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

// Throws Error unless a file can be made at `path`: asked before long work whose result goes there.
void check_writable(const std::filesystem::path& path);

}  // namespace tarn
