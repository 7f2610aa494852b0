#include "gl/program_cache.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <span>

#include "core/error.h"
#include "core/files.h"

namespace tarn::gl {

namespace {

namespace fs = std::filesystem;

constexpr char extension[] = ".program";

// FNV-1a (Fowler, Noll & Vo), 64 bits.
std::uint64_t hash_of(const void* data, std::size_t size) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

// A file: this, the key, the binary.
struct Head {
    char magic[8] = {'t', 'a', 'r', 'n', 'p', 'r', 'g', '1'};
    std::uint64_t key_bytes = 0;
    std::uint64_t binary_bytes = 0;
    std::uint64_t binary_hash = 0;
    std::uint64_t format = 0;
};
static_assert(sizeof(Head) == 40);

}  // namespace

fs::path ProgramCache::path_of(const std::string& key) const {
    return folder_ / (fmt::format("{:016x}", hash_of(key.data(), key.size())) + extension);
}

std::optional<ProgramBinary> ProgramCache::find(const std::string& key) const {
    if (folder_.empty()) return std::nullopt;
    const fs::path path = path_of(key);
    std::error_code error;
    if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > bytes_max_) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const std::size_t before = sizeof(Head) + key.size();
    if (!file || bytes.size() <= before) return std::nullopt;
    const Head expected;
    Head head;
    std::memcpy(&head, bytes.data(), sizeof(head));
    // The whole key is kept and compared: two keys of one hash must not be taken for each other.
    const char* const binary = bytes.data() + before;
    const bool whole = std::memcmp(head.magic, expected.magic, sizeof(head.magic)) == 0 &&
                       head.key_bytes == key.size() && head.binary_bytes == bytes.size() - before &&
                       std::memcmp(bytes.data() + sizeof(head), key.data(), key.size()) == 0 &&
                       hash_of(binary, head.binary_bytes) == head.binary_hash;
    if (!whole) return std::nullopt;
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);
    return ProgramBinary{static_cast<GLenum>(head.format), {binary, binary + head.binary_bytes}};
}

void ProgramCache::keep(const std::string& key, const ProgramBinary& binary) const {
    if (folder_.empty() || binary.bytes.empty()) return;
    Head head;
    head.key_bytes = key.size();
    head.binary_bytes = binary.bytes.size();
    head.binary_hash = hash_of(binary.bytes.data(), binary.bytes.size());
    head.format = binary.format;
    std::vector<std::uint8_t> bytes(sizeof(head));
    std::memcpy(bytes.data(), &head, sizeof(head));
    bytes.insert(bytes.end(), key.begin(), key.end());
    bytes.insert(bytes.end(), binary.bytes.begin(), binary.bytes.end());
    if (bytes.size() > bytes_max_) return;
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) return;
    static std::mutex
        one_at_a_time;  // files are written beside their names and renamed, one such name a process
    const std::scoped_lock lock(one_at_a_time);
    try {
        write_file(path_of(key), std::span<const std::uint8_t>(bytes));
        make_room();
    } catch (const std::exception&) {
        return;  // a full disk, a folder of somebody else's: the program is there, only not kept
    }
}

void ProgramCache::forget(const std::string& key) const {
    if (folder_.empty()) return;
    std::error_code ignored;
    fs::remove(path_of(key), ignored);
}

void ProgramCache::make_room() const {
    struct Kept {
        fs::path path;
        fs::file_time_type used;
        std::uintmax_t bytes;
    };
    std::vector<Kept> files;
    std::uintmax_t sum = 0;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
        if (entry.path().extension() != extension) continue;
        const std::uintmax_t bytes = entry.file_size(error);
        if (error) continue;  // another process took it
        const fs::file_time_type used = entry.last_write_time(error);
        if (error) continue;
        files.push_back({entry.path(), used, bytes});
        sum += bytes;
    }
    std::sort(files.begin(), files.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
    for (std::size_t i = 0; sum > bytes_max_ && i < files.size(); ++i) {
        fs::remove(files[i].path, error);
        sum -= files[i].bytes;
    }
}

fs::path program_cache_folder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value == nullptr ? "" : value);
    };
    if (variable("TARN_PROGRAM_CACHE") == "off") return {};
    // The XDG base directory specification: a relative path is to be ignored.
    const fs::path cache = variable("XDG_CACHE_HOME");
    if (cache.is_absolute()) return cache / "tarn";
    const fs::path home = variable("HOME");
    return home.is_absolute() ? home / ".cache" / "tarn" : fs::path();
}

}  // namespace tarn::gl
