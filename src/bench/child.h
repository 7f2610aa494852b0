// Runs this program again, as a child, and says what it took.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace tarn {

struct ChildRun {
    double wall_s = 0;    // from its start to its end, to 2 ms
    double peak_mib = 0;  // most memory that it held, up to 2 ms before its end
};

// `environment` is set beside what this program has. Its standard output is dropped. Throws Error with the
// exit code where it fails.
ChildRun run_self(const std::vector<std::string>& arguments,
                  const std::vector<std::pair<std::string, std::string>>& environment);

// A new folder below the system's folder for temporary files; removed with all in it at the end.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace tarn
