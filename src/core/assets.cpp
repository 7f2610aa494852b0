#include "core/assets.h"

#include <algorithm>
#include <chrono>

#include "core/error.h"
#include "core/files.h"

namespace tarn {

extern const EmbeddedAsset embedded_assets[];

namespace {

// True for a program started from the build tree that made it; an installed one uses what it carries.
bool runs_from_build_tree() {
    std::error_code ignored;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
    return !ignored && self.string().starts_with(TARN_BUILD_ROOT) &&
           std::filesystem::exists(TARN_SOURCE_ROOT "/glsl", ignored);
}

}  // namespace

std::optional<std::filesystem::path> asset_on_disk(const std::string& path) {
    static const bool from_disk = runs_from_build_tree();
    if (!from_disk) return std::nullopt;
    return std::filesystem::path(TARN_SOURCE_ROOT) / path;
}

std::string read_asset(const std::string& path) {
    if (const auto file = asset_on_disk(path)) {
        if (std::filesystem::exists(*file)) return read_text_file(*file);
    }
    for (const EmbeddedAsset* asset = embedded_assets; *asset->path != '\0'; ++asset) {
        if (path == asset->path) return std::string(asset->text);
    }
    fail("{}: no such asset in this program", path);
}

std::vector<std::string> list_assets(const std::string& folder) {
    std::vector<std::string> paths;
    for (const EmbeddedAsset* asset = embedded_assets; *asset->path != '\0'; ++asset) {
        if (std::string_view(asset->path).starts_with(folder)) paths.emplace_back(asset->path);
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::string asset_name(const std::string& path) {
    return std::filesystem::path(path).stem().string();
}

std::int64_t asset_stamp(const std::string& path) {
    const auto file = asset_on_disk(path);
    if (!file) return 0;
    std::error_code missing;
    const auto time = std::filesystem::last_write_time(*file, missing);
    // Counted from 1970: the file clock's own counts are negative until 2174.
    return missing ? 0 : std::int64_t{std::chrono::file_clock::to_sys(time).time_since_epoch().count()};
}

}  // namespace tarn
