// Lists of names on the command line.
#pragma once
#include <string>
#include <vector>

namespace tarn {

// The parts of `list`, separated by commas, each once; `all` where it is empty. Throws Error naming `option`
// and what is allowed for a name that is not in `all`.
std::vector<std::string> names_of(const std::string& option, const std::string& list,
                                  const std::vector<std::string>& all);

// Makes the folder given to --out and tries whether the `files` in it can be written. Throws Error.
void make_folder(const std::string& folder, const std::vector<std::string>& files);

}  // namespace tarn
