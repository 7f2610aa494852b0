// A folder of its own that a test works in, empty at first, gone afterwards.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace tarn {

// The working directory while it lives.
class Folder {
  public:
    Folder() {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
        std::filesystem::current_path(path_);
    }
    ~Folder() {
        std::filesystem::current_path(before_);
        std::filesystem::remove_all(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

  private:
    std::filesystem::path before_ = std::filesystem::current_path();
    std::filesystem::path path_ =
        std::filesystem::path(testing::TempDir()) / fmt::format("tarn_app_test_{}", getpid());
};

}  // namespace tarn
