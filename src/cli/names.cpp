#include "cli/names.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "core/error.h"
#include "core/files.h"

namespace tarn {

std::vector<std::string> names_of(const std::string& option, const std::string& list,
                                  const std::vector<std::string>& all) {
    if (list.empty()) return all;
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t comma = std::min(list.find(',', begin), list.size());
        const std::string name = list.substr(begin, comma - begin);
        if (std::find(all.begin(), all.end(), name) == all.end())
            fail("{} {}: no such name; allowed: {}", option, name, fmt::join(all, ", "));
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        begin = comma + 1;
    }
    return names;
}

void make_folder(const std::string& folder, const std::vector<std::string>& files) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail("--out {}: cannot make the folder: {}", folder, error.message());
    for (const std::string& name : files) check_writable(std::filesystem::path(folder) / name);
}

}  // namespace tarn
