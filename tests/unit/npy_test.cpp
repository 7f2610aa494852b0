#include "world/npy.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "core/files.h"

namespace tarn {
namespace {

namespace fs = std::filesystem;

class Npy : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    std::string error_of_reading(const std::string& bytes) {
        write_file(folder_ / "bad.npy", bytes);
        try {
            read_npy(folder_ / "bad.npy");
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("tarn_npy_{}", getpid());
};

TEST_F(Npy, HoldsTheFormatByteForByte) {
    Cells cells({2, 3, 4});
    for (std::size_t i = 0; i < cells.count(); ++i) cells.bytes()[i] = static_cast<std::uint8_t>(60 + i);
    write_npy(folder_ / "a.npy", cells);
    const std::string bytes = read_text_file(folder_ / "a.npy");
    // What numpy.save writes for an array of shape (4, 3, 2): see numpy/lib/format.py.
    std::string expected("\x93NUMPY\x01\x00\x76\x00", 10);
    expected += "{'descr': '|u1', 'fortran_order': False, 'shape': (4, 3, 2), }";
    expected.resize(127, ' ');
    expected += '\n';
    for (int i = 60; i < 84; ++i) expected += static_cast<char>(i >= 64 && i <= 79 ? 64 : i);
    EXPECT_EQ(bytes, expected);
}

TEST_F(Npy, HeadersOfEverySizeEndOnAMultipleOf64) {
    for (const glm::ivec3 size : {glm::ivec3(1), glm::ivec3(1024, 1, 1), glm::ivec3(10, 100, 1)}) {
        write_npy(folder_ / "a.npy", Cells(size));
        const std::string bytes = read_text_file(folder_ / "a.npy");
        EXPECT_EQ((bytes.size() - Cells(size).count()) % 64, 0u);
        EXPECT_EQ(read_npy(folder_ / "a.npy"), Cells(size));
    }
}

TEST_F(Npy, ReadsBackWhatItWroteWithoutAmounts) {
    Cells cells({7, 13, 5});
    for (std::size_t i = 0; i < cells.count(); ++i) cells.bytes()[i] = static_cast<std::uint8_t>(i * 7);
    write_npy(folder_ / "a.npy", cells);
    Cells expected = cells;
    for (std::uint8_t& byte : expected.bytes()) byte = static_cast<std::uint8_t>(material_of(byte));
    EXPECT_NE(expected, cells);
    EXPECT_EQ(read_npy(folder_ / "a.npy"), expected);
}

TEST_F(Npy, AmountsAreQuantaOfEveryByte) {
    Cells cells({16, 4, 4});
    for (std::size_t i = 0; i < cells.count(); ++i) cells.bytes()[i] = static_cast<std::uint8_t>(i);
    write_amounts_npy(folder_ / "a.npy", cells);
    const Cells amounts = read_npy(folder_ / "a.npy");
    ASSERT_EQ(amounts.size_vox(), cells.size_vox());
    for (int i = 0; i < 256; ++i) EXPECT_EQ(amounts.bytes()[i], i >= 64 && i <= 79 ? i - 63 : 0) << i;
}

TEST_F(Npy, RefusesWhatIsNotSuchAFile) {
    write_npy(folder_ / "a.npy", Cells({2, 3, 4}));
    const std::string good = read_text_file(folder_ / "a.npy");
    const auto with = [&good](std::string_view from, std::string_view to) {
        std::string bad = good;
        return bad.replace(bad.find(from), from.size(), to);
    };
    EXPECT_NE(error_of_reading("").find("no .npy 1.0 header"), std::string::npos);
    EXPECT_NE(error_of_reading(good.substr(0, 40)).find("cut short"), std::string::npos);
    EXPECT_NE(error_of_reading(good.substr(0, good.size() - 1)).find("23 bytes of data"), std::string::npos);
    EXPECT_NE(error_of_reading(good + "x").find("25 bytes of data"), std::string::npos);
    EXPECT_NE(error_of_reading(with("|u1", "<f4")).find("another type"), std::string::npos);
    EXPECT_NE(error_of_reading(with("False", "True ")).find("another type or order"), std::string::npos);
    EXPECT_NE(error_of_reading(with("(4, 3, 2)", "(4, 6)   ")).find("three sides"), std::string::npos);
    EXPECT_NE(error_of_reading(with("(4, 3, 2)", "(0, 3, 2)")).find("in range"), std::string::npos);
    EXPECT_NE(error_of_reading(with("(4, 3, 2), }", "(9999, 3, 2)")).find("in range"), std::string::npos);
    EXPECT_NE(error_of_reading(with("(4,", "(x,")).find("in range"), std::string::npos);
}

TEST_F(Npy, AFileThatCannotBeWrittenIsAnErrorAndLeavesNothing) {
    EXPECT_THROW(write_npy(folder_ / "none" / "a.npy", Cells({1, 1, 1})), Error);
    EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace tarn
