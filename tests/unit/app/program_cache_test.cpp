// The cache of linked programs on disk: what is kept comes back; what is damaged, foreign or cannot be
// written does no harm.
#include "gl/program_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "core/files.h"

namespace tarn::gl {
namespace {

namespace fs = std::filesystem;

class ProgramCacheTest : public testing::Test {
  protected:
    ProgramCacheTest() : folder_(fs::path(testing::TempDir()) / ("tarn_cache_" + std::to_string(getpid()))) {
        fs::remove_all(folder_);
    }
    ~ProgramCacheTest() override { fs::remove_all(folder_); }

    static ProgramBinary binary(std::size_t bytes = 1000) {
        ProgramBinary made{0x875f, std::vector<std::uint8_t>(bytes)};
        for (std::size_t i = 0; i < bytes; ++i) made.bytes[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
        return made;
    }
    fs::path folder_;
    ProgramCache cache_{folder_};
};

TEST_F(ProgramCacheTest, KeepsAndFinds) {
    EXPECT_FALSE(cache_.find("key").has_value());
    cache_.keep("key", binary());
    const auto found = cache_.find("key");
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->format, 0x875fu);
    EXPECT_EQ(found->bytes, binary().bytes);
    EXPECT_FALSE(cache_.find("another key").has_value());
    cache_.keep("key", binary(7));
    EXPECT_EQ(cache_.find("key")->bytes.size(), 7u);
    cache_.forget("key");
    EXPECT_FALSE(cache_.find("key").has_value());
}

TEST_F(ProgramCacheTest, WhatIsCutOffOrDamagedAnywhereCountsAsMissing) {
    cache_.keep("key", binary(64));
    const fs::path path = cache_.path_of("key");
    const std::string whole = read_text_file(path);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write_file(path, whole.substr(0, length));
        EXPECT_FALSE(cache_.find("key").has_value()) << length;
    }
    write_file(path, whole + "x");
    EXPECT_FALSE(cache_.find("key").has_value());
    constexpr std::size_t format_at = 32;  // the driver's name for its format is checked by who loads it
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (i >= format_at && i < format_at + 8) continue;
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        write_file(path, damaged);
        EXPECT_FALSE(cache_.find("key").has_value()) << i;
    }
    cache_.keep("key", binary(64));
    EXPECT_TRUE(cache_.find("key").has_value()) << "a bad file is written anew";
}

TEST_F(ProgramCacheTest, AFileOfAnotherKeyUnderThisNameIsNotTaken) {
    cache_.keep("one", binary());
    fs::rename(cache_.path_of("one"), cache_.path_of("two"));
    EXPECT_FALSE(cache_.find("two").has_value());
}

TEST_F(ProgramCacheTest, WhatCannotBeReadOrWrittenIsNoError) {
    fs::create_directories(cache_.path_of("key"));  // a folder in the file's place
    EXPECT_FALSE(cache_.find("key").has_value());
    cache_.keep("key", binary());
    EXPECT_FALSE(cache_.find("key").has_value());
    write_file(folder_ / "file", "");
    const ProgramCache below_a_file(folder_ / "file");
    below_a_file.keep("key", binary());
    EXPECT_FALSE(below_a_file.find("key").has_value());
    const ProgramCache of_the_system("/proc/tarn");
    of_the_system.keep("key", binary());
    EXPECT_FALSE(of_the_system.find("key").has_value());
    const ProgramCache none{fs::path()};
    none.keep("key", binary());
    EXPECT_FALSE(none.find("key").has_value());
}

TEST_F(ProgramCacheTest, KeepsNoMoreThanItMayAndDropsWhatWasUnusedForLongest) {
    const ProgramCache small(folder_, 5000);
    for (const char* key : {"a", "b", "c"}) small.keep(key, binary(1000));
    // Three of about 1 KB: two more fit once the oldest has gone. `a` was used last.
    const auto now = fs::file_time_type::clock::now();
    fs::last_write_time(small.path_of("b"), now - std::chrono::hours(2));
    fs::last_write_time(small.path_of("c"), now - std::chrono::hours(1));
    fs::last_write_time(small.path_of("a"), now - std::chrono::hours(3));
    ASSERT_TRUE(small.find("a").has_value());
    small.keep("d", binary(2500));
    EXPECT_TRUE(small.find("a").has_value());
    EXPECT_FALSE(small.find("b").has_value());
    EXPECT_TRUE(small.find("c").has_value());
    EXPECT_TRUE(small.find("d").has_value());
    small.keep("e", binary(6000));  // more than all
    EXPECT_FALSE(small.find("e").has_value());
    EXPECT_TRUE(small.find("d").has_value());
}

TEST(ProgramCacheFolder, FollowsTheEnvironment) {
    const auto with = [](const char* cache, const char* home, const char* use) {
        for (const auto& [name, value] :
             {std::pair("XDG_CACHE_HOME", cache), {"HOME", home}, {"TARN_PROGRAM_CACHE", use}})
            value == nullptr ? unsetenv(name) : setenv(name, value, 1);
        return program_cache_folder();
    };
    const char* const home_before = std::getenv("HOME");
    const std::string home = home_before == nullptr ? "" : home_before;
    EXPECT_EQ(with("/cache", "/home/me", nullptr), "/cache/tarn");
    EXPECT_EQ(with(nullptr, "/home/me", nullptr), "/home/me/.cache/tarn");
    EXPECT_EQ(with("relative", "/home/me", nullptr), "/home/me/.cache/tarn");
    EXPECT_EQ(with(nullptr, nullptr, nullptr), "");
    EXPECT_EQ(with("/cache", "/home/me", "off"), "");
    with(nullptr, home.c_str(), nullptr);
}

}  // namespace
}  // namespace tarn::gl
