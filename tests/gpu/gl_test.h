// Base of the GPU tests: one headless context per process, and no GL error by the end of each test.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>

#include "gl/context.h"
#include "platform/platform.h"

namespace tarn {

class GlTest : public testing::Test {
  protected:
    static void SetUpTestSuite() { platform() = make_headless({64, 64}, 1); }
    static void TearDownTestSuite() { platform().reset(); }
    void SetUp() override { gl::clear_debug_log(); }
    void TearDown() override {
        gl::collect_errors();
        EXPECT_EQ(gl::debug_log().high_severity, 0)
            << fmt::format("{}", fmt::join(gl::debug_log().messages, "\n"));
    }
    static std::unique_ptr<Platform>& platform() {
        static std::unique_ptr<Platform> instance;
        return instance;
    }
};

}  // namespace tarn

// Every GPU test program has this main: GoogleTest's, in a file of its own so that it links once.
int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
