// Linked programs as the driver hands them out, kept on disk between runs: below $XDG_CACHE_HOME/tarn, else
// ~/.cache/tarn. Never an error: a file that is damaged, cut off or of something else counts as missing, and
// a folder that cannot be written keeps nothing. Safe to use from several threads and processes at once.
#pragma once
#include <glad/gl.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tarn::gl {

struct ProgramBinary {
    GLenum format = 0;  // the driver's
    std::vector<std::uint8_t> bytes;
};

class ProgramCache {
  public:
    // All files together; the ones that were not used for longest go first.
    static constexpr std::uintmax_t bytes_max = std::uintmax_t{64} << 20;

    // An empty folder keeps nothing. `folder` is made when first written to.
    explicit ProgramCache(std::filesystem::path folder, std::uintmax_t most_bytes = bytes_max)
        : folder_(std::move(folder)), bytes_max_(most_bytes) {}

    // `key`: everything that the binary follows from.
    std::optional<ProgramBinary> find(const std::string& key) const;
    void keep(const std::string& key, const ProgramBinary& binary) const;
    void forget(const std::string& key) const;

    std::filesystem::path path_of(const std::string& key) const;

  private:
    void make_room() const;

    std::filesystem::path folder_;
    std::uintmax_t bytes_max_;
};

// The folder of this user; empty where none is named or TARN_PROGRAM_CACHE=off.
std::filesystem::path program_cache_folder();

}  // namespace tarn::gl
