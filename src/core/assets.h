// Text files that belong to the program (shaders, scenes): embedded at build time; a program that runs from
// its build tree reads the source tree instead, so that edited shaders take effect.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tarn {

struct EmbeddedAsset {
    const char* path;  // relative to the repository root; "" ends the table
    std::string_view text;
};

// Where `path` lies on disk, if this program reads assets from disk.
std::optional<std::filesystem::path> asset_on_disk(const std::string& path);

// Text of the asset `path`, e.g. "glsl/pass/trace.frag". Throws Error if there is none.
std::string read_asset(const std::string& path);

// Paths of the embedded assets below `folder`, sorted.
std::vector<std::string> list_assets(const std::string& folder);

// As scenes and recordings are called: "lake" of "assets/scenes/lake.json".
std::string asset_name(const std::string& path);

// When the file behind an asset was written: above 0, and grows with time; 0 if embedded or missing.
std::int64_t asset_stamp(const std::string& path);

}  // namespace tarn
