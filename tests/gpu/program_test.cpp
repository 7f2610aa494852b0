// gl::Program and gl::Framebuffer refuse what would otherwise fail silently; the frame block has one layout
// in both languages.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gpu/gl_test.h"
#include "shared/bindings.h"
#include "shared/frame.h"

namespace tarn {
namespace {

using ProgramTest = GlTest;

std::string error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST_F(ProgramTest, frame_block_has_the_same_offsets_in_glsl_and_cpp) {
    const gl::Program program({.label = "frame block", .compute = "tests/kernels/frame_block.comp"});
    const GLuint block = glGetProgramResourceIndex(program.name(), GL_UNIFORM_BLOCK, "FrameBlock");
    ASSERT_NE(block, GL_INVALID_INDEX);
    constexpr GLenum block_properties[] = {GL_BUFFER_DATA_SIZE, GL_NUM_ACTIVE_VARIABLES};
    GLint block_values[2]{};
    glGetProgramResourceiv(program.name(), GL_UNIFORM_BLOCK, block, 2, block_properties, 2, nullptr,
                           block_values);
    EXPECT_EQ(block_values[0], static_cast<GLint>(sizeof(FrameBlock)));

    int fields = 0;
    const auto expect_offset = [&](const char* name, std::size_t offset) {
        ++fields;
        const std::string member = fmt::format("FrameBlock.{}", name);
        const GLuint index = glGetProgramResourceIndex(program.name(), GL_UNIFORM, member.c_str());
        ASSERT_NE(index, GL_INVALID_INDEX) << member;
        constexpr GLenum property = GL_OFFSET;
        GLint value = -1;
        glGetProgramResourceiv(program.name(), GL_UNIFORM, index, 1, &property, 1, nullptr, &value);
        EXPECT_EQ(value, static_cast<GLint>(offset)) << member;
    };
#define TARN_FIELD(type, name) expect_offset(#name, offsetof(FrameBlock, name));
    TARN_FRAME_FIELDS(TARN_FIELD)
#undef TARN_FIELD
    EXPECT_EQ(block_values[1], fields);
}

TEST_F(ProgramTest, DrawsOnlyTheRowsThatAreAskedFor) {
    const glm::ivec2 size(2, 8);
    const gl::Program program({.label = "rows",
                               .compute = {},
                               .vertex = "pass/fullscreen.vert",
                               .fragment = "pass/display.frag",
                               .defines = {{"DISPLAY_RADIANCE", "1"}}});
    FrameBlock block{};
    block.size_px = glm::ivec4(size, size);
    gl::Buffer frame("frame block", sizeof(block));
    frame.upload(std::span(&block, 1));
    frame.bind_uniform(BINDING_FRAME);
    const gl::Texture ones({.label = "ones", .format = GL_RGBA32F, .size = {size, 0}});
    const gl::Texture picture({.label = "picture", .format = GL_RGBA32F, .size = {size, 0}});
    const float one[] = {1, 1, 1, 1};
    glClearTexImage(ones.name(), 0, GL_RGBA, GL_FLOAT, one);
    ones.bind_image(IMAGE_RADIANCE, GL_READ_ONLY);
    const gl::Framebuffer target("picture", {&picture});
    const auto drawn_after = [&](auto draw) {
        glClearTexImage(picture.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
        program.use();
        draw();
        std::vector<float> pixels(std::size_t{2} * 8);
        picture.download(std::span(pixels), GL_RED, GL_FLOAT);
        std::string rows;
        for (std::size_t y = 0; y < 8; ++y) rows += pixels[2 * y] == 1 && pixels[2 * y + 1] == 1 ? '#' : '.';
        return rows;
    };
    EXPECT_EQ(drawn_after([&] { target.draw_rows({2, 3}); }), "..###...");
    EXPECT_EQ(drawn_after([&] { target.draw_fullscreen(); }), "########");
}

TEST_F(ProgramTest, frame_block_values_arrive) {
    const gl::Program program({.label = "frame block", .compute = "tests/kernels/frame_block.comp"});
    FrameBlock block;
    block.camera_position_vox.x = 1.5f;
    block.counters.y = 4'000'000'000u;
    block.display.w = -7;
    gl::Buffer uniform("frame block", sizeof(block));
    uniform.upload(std::span<const FrameBlock>(&block, 1));
    uniform.bind_uniform(0);
    gl::Buffer result("result", 4 * sizeof(float));
    result.bind_storage(0);
    program.dispatch({1, 1, 1});
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    float values[4]{};
    result.download(std::span<float>(values));
    EXPECT_EQ(values[0], 1.5f);
    EXPECT_EQ(values[1], 4'000'000'000.0f);
    EXPECT_EQ(values[2], -7.0f);
}

TEST_F(ProgramTest, unknown_uniform_is_an_error_that_names_it) {
    const gl::Program program(
        {.label = "display", .vertex = "pass/fullscreen.vert", .fragment = "pass/display.frag"});
    const std::string error = error_of([&] { program.set("exposure_of_nothing", 1.0f); });
    EXPECT_NE(error.find("exposure_of_nothing"), std::string::npos) << error;
    EXPECT_NE(error.find("display"), std::string::npos) << error;
}

TEST_F(ProgramTest, shader_error_names_the_file_and_line) {
    const std::string error = error_of(
        [] { const gl::Program program({.label = "broken", .compute = "tests/kernels/broken.comp"}); });
    EXPECT_NE(error.find("tests/kernels/broken.comp"), std::string::npos) << error;
    EXPECT_NE(error.find("no_such_function"), std::string::npos) << error;
    // The included file comes second; what follows the include counts on from it.
    EXPECT_NE(error.find("0:8("), std::string::npos) << error;
    EXPECT_NE(error.find("1: glsl/shared/hash.h"), std::string::npos) << error;
}

TEST_F(ProgramTest, missing_file_is_an_error_that_names_it) {
    const std::string error =
        error_of([] { const gl::Program program({.label = "none", .compute = "pass/none.comp"}); });
    EXPECT_NE(error.find("glsl/pass/none.comp"), std::string::npos) << error;
}

TEST_F(ProgramTest, a_target_that_cannot_be_drawn_into_is_an_error) {
    // Shared exponents are for reading only.
    const gl::Texture texture({.label = "sky", .format = GL_RGB9_E5, .size = {8, 4, 0}});
    const std::string error = error_of([&] { const gl::Framebuffer target("sky target", {&texture}); });
    EXPECT_NE(error.find("sky target of 8x4"), std::string::npos) << error;
}

// A kernel that is edited while its program runs: it stores `factor` times 3, or what the edit makes of it.
class ReloadTest : public ProgramTest {
  protected:
    ReloadTest() { edit("factor * 3"); }
    ~ReloadTest() override { std::filesystem::remove(path_); }

    void edit(const std::string& value) {
        write_file(path_,
                   "layout(local_size_x = 1) in;\n"
                   "layout(std430, binding = 0) buffer Result { int result; };\n"
                   "uniform int factor;\n"
                   "void main() { result = " +
                       value + "; }\n");
        // Two edits within the file system's clock tick are one to it.
        written_ += std::chrono::seconds(1);
        std::filesystem::last_write_time(path_, written_);
    }
    static int run(const gl::Program& program) {
        gl::Buffer buffer("result", sizeof(int));
        buffer.bind_storage(0);
        program.set("factor", 7);
        program.dispatch({1, 1, 1});
        int result = 0;
        buffer.download(std::span(&result, 1));
        return result;
    }

    std::filesystem::path path_ =
        std::filesystem::path(testing::TempDir()) / fmt::format("tarn_reload_{}.comp", getpid());
    std::filesystem::file_time_type written_ = std::filesystem::file_time_type::clock::now();
};

TEST_F(ReloadTest, an_edit_takes_effect_once) {
    gl::Program program({.label = "edited", .compute = path_.string()});
    EXPECT_EQ(run(program), 21);
    EXPECT_FALSE(program.poll_reload().has_value());
    edit("factor * 4");
    EXPECT_EQ(program.poll_reload(), "");
    EXPECT_EQ(run(program), 28);
    EXPECT_FALSE(program.poll_reload().has_value());
}

TEST_F(ReloadTest, an_edit_that_does_not_compile_keeps_the_program) {
    gl::Program program({.label = "edited", .compute = path_.string()});
    edit("no_such_name");
    const std::string error = program.poll_reload().value_or("nothing");
    EXPECT_NE(error.find("no_such_name"), std::string::npos) << error;
    EXPECT_NE(error.find(path_.string()), std::string::npos) << error;
    EXPECT_EQ(run(program), 21);
    EXPECT_FALSE(program.poll_reload().has_value()) << "one message an edit";
    edit("factor * 5");
    EXPECT_EQ(program.poll_reload(), "");
    EXPECT_EQ(run(program), 35);
}

TEST_F(ReloadTest, an_edit_that_loses_a_uniform_keeps_the_program) {
    gl::Program program({.label = "edited", .compute = path_.string()});
    EXPECT_EQ(run(program), 21);
    edit("8");
    const std::string error = program.poll_reload().value_or("nothing");
    EXPECT_NE(error.find("factor"), std::string::npos) << error;
    EXPECT_NE(error.find("edited"), std::string::npos) << error;
    EXPECT_EQ(run(program), 21);
    edit("factor * 6");
    EXPECT_EQ(program.poll_reload(), "");
    EXPECT_EQ(run(program), 42);
}

}  // namespace
}  // namespace tarn
