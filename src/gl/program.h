// A linked GLSL program made from asset files. #include "lib/x.glsl" is resolved here, below glsl/. When its
// files change, poll_reload() builds it anew; a program that fails keeps its predecessor.
#pragma once
#include <glad/gl.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tarn::gl {

struct ProgramDesc {
    const char* label = "";
    std::string compute{};             // path below glsl/ (a test's: tests/kernels/... or absolute), or
    std::string vertex{}, fragment{};  // both
    std::vector<std::pair<std::string, std::string>> defines{};
};

struct ShaderText {
    std::string text;
    std::vector<std::string> files;  // asset paths, in the order of their #line numbers
};

// The stage's full text: #version, defines, includes resolved (each file once). Throws Error on a missing
// file.
ShaderText shader_text(const std::string& path,
                       const std::vector<std::pair<std::string, std::string>>& defines);

class Program {
  public:
    Program() = default;
    // Throws Error with the driver's log when it does not compile or link.
    explicit Program(ProgramDesc desc);
    ~Program();
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;

    GLuint name() const { return name_; }
    const char* label() const { return desc_.label; }
    // Not compiled but loaded as the driver linked it in an earlier run.
    bool was_cached() const { return was_cached_; }
    void use() const { glUseProgram(name_); }

    // Runs `groups` workgroups; the program is a compute program.
    void dispatch(glm::uvec3 groups) const;
    // Enough workgroups of `local` for `items`.
    void dispatch_for(glm::ivec3 items, glm::ivec3 local) const;

    // Each throws Error when the program has no such active uniform.
    void set(const char* uniform, int value) const;
    void set(const char* uniform, std::uint32_t value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, glm::ivec2 value) const;
    void set(const char* uniform, glm::ivec3 value) const;
    void set(const char* uniform, glm::uvec3 value) const;
    void set(const char* uniform, glm::vec2 value) const;
    void set(const char* uniform, glm::vec3 value) const;
    void set(const char* uniform, glm::vec4 value) const;

    // Nothing changed: nullopt. Rebuilt: "". Failed, or without a uniform that was set before: the error, and
    // the old program stays.
    std::optional<std::string> poll_reload();

  private:
    GLint location(const char* uniform) const;

    ProgramDesc desc_;
    GLuint name_ = 0;
    std::vector<std::string> files_;
    std::int64_t stamp_ = 0;
    bool was_cached_ = false;
    mutable std::unordered_map<std::string, GLint> locations_;
};

}  // namespace tarn::gl
