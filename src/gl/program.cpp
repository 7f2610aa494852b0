#include "gl/program.h"

#include <algorithm>
#include <sstream>

#include "core/assets.h"
#include "core/error.h"
#include "gl/context.h"
#include "gl/program_cache.h"

namespace tarn::gl {

namespace {

void append_file(const std::string& path, ShaderText& out) {
    // Kernels of tests stay beside them, or in a folder of the test's, and are read from disk only.
    const bool of_test = path.starts_with("tests/") || path.starts_with('/');
    const std::string asset = of_test ? path : "glsl/" + path;
    if (std::find(out.files.begin(), out.files.end(), asset) != out.files.end()) return;
    const std::size_t index = out.files.size();
    out.files.push_back(asset);
    std::istringstream lines(read_asset(asset));
    std::string line;
    int number = 0;
    out.text += fmt::format("#line 1 {}\n", index);
    while (std::getline(lines, line)) {
        ++number;
        constexpr std::string_view directive = "#include \"";
        if (line.starts_with(directive)) {
            const auto end = line.find('"', directive.size());
            if (end == std::string::npos) fail("{}:{}: #include needs a closing quote", asset, number);
            append_file(line.substr(directive.size(), end - directive.size()), out);
            out.text += fmt::format("#line {} {}\n", number + 1, index);
        } else {
            out.text += line;
            out.text += '\n';
        }
    }
}

// Driver logs name files by number: "3:17(5): error"; a legend makes them readable.
std::string legend(const ShaderText& source) {
    std::string text;
    for (std::size_t i = 0; i < source.files.size(); ++i)
        text += fmt::format("  {}: {}\n", i, source.files[i]);
    return text;
}

class Shader {
  public:
    Shader(GLenum type, const ShaderText& source) : name_(glCreateShader(type)) {
        const char* text = source.text.c_str();
        glShaderSource(name_, 1, &text, nullptr);
        glCompileShader(name_);
        GLint ok = 0;
        glGetShaderiv(name_, GL_COMPILE_STATUS, &ok);
        if (ok == 0) {
            GLint length = 0;
            glGetShaderiv(name_, GL_INFO_LOG_LENGTH, &length);
            std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
            glGetShaderInfoLog(name_, length, nullptr, log.data());
            glDeleteShader(name_);
            fail("{}: shader does not compile:\n{}\nfiles:\n{}", source.files.front(), log.c_str(),
                 legend(source));
        }
    }
    ~Shader() { glDeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    GLuint name() const { return name_; }

  private:
    GLuint name_;
};

struct Built {
    GLuint name;
    std::vector<std::string> files;
    bool was_cached;
};

struct Stage {
    GLenum type;
    ShaderText source;
};

bool is_linked(GLuint program) {
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    return ok != 0;
}

void compile_and_link(GLuint program, const std::vector<Stage>& stages, const char* label) {
    for (const Stage& stage : stages) {
        const Shader shader(stage.type, stage.source);
        glAttachShader(program, shader.name());
    }
    glProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(program);
    if (is_linked(program)) return;
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, length, nullptr, log.data());
    fail("{}: program does not link:\n{}", label, log.c_str());
}

// Binaries that this driver takes; none where it hands none out, as Mesa does while its own cache is off.
std::vector<GLint> binary_formats() {
    GLint count = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
    std::vector<GLint> formats(static_cast<std::size_t>(std::max(count, 0)));
    if (count > 0) glGetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats.data());
    return formats;
}

// Everything that the binary follows from.
std::string cache_key(const std::vector<Stage>& stages) {
    const DriverInfo driver = driver_info();
    std::string key =
        fmt::format("tarn {}\n{}\n{}\n{}\n", TARN_VERSION, driver.vendor, driver.renderer, driver.version);
    for (const Stage& stage : stages) key += fmt::format("stage {:#x}\n{}", stage.type, stage.source.text);
    return key;
}

// True where `program` is now what the cache held for `key`.
bool load(GLuint program, const ProgramCache& cache, const std::string& key,
          const std::vector<GLint>& formats) {
    const auto binary = cache.find(key);
    if (!binary) return false;
    const bool known =
        std::find(formats.begin(), formats.end(), static_cast<GLint>(binary->format)) != formats.end();
    if (known)
        glProgramBinary(program, binary->format, binary->bytes.data(),
                        static_cast<GLsizei>(binary->bytes.size()));
    if (known && is_linked(program)) return true;
    cache.forget(key);
    return false;
}

void keep(GLuint program, const ProgramCache& cache, const std::string& key) {
    GLint length = 0;
    glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0) return;
    ProgramBinary binary;
    binary.bytes.resize(static_cast<std::size_t>(length));
    GLsizei written = 0;
    glGetProgramBinary(program, length, &written, &binary.format, binary.bytes.data());
    binary.bytes.resize(static_cast<std::size_t>(std::max(written, 0)));
    cache.keep(key, binary);
}

Built build(const ProgramDesc& desc) {
    std::vector<Stage> stages;
    if (!desc.compute.empty()) {
        stages.push_back({GL_COMPUTE_SHADER, shader_text(desc.compute, desc.defines)});
    } else {
        stages.push_back({GL_VERTEX_SHADER, shader_text(desc.vertex, desc.defines)});
        stages.push_back({GL_FRAGMENT_SHADER, shader_text(desc.fragment, desc.defines)});
    }
    Built built{glCreateProgram(), {}, false};
    for (const Stage& stage : stages)
        built.files.insert(built.files.end(), stage.source.files.begin(), stage.source.files.end());
    const ProgramCache cache(program_cache_folder());
    const std::vector<GLint> formats = binary_formats();
    const std::string key = formats.empty() ? std::string() : cache_key(stages);
    built.was_cached = !formats.empty() && load(built.name, cache, key, formats);
    if (!built.was_cached) {
        try {
            compile_and_link(built.name, stages, desc.label);
        } catch (...) {
            glDeleteProgram(built.name);
            throw;
        }
        if (!formats.empty()) keep(built.name, cache, key);
    }
    glObjectLabel(GL_PROGRAM, built.name, -1, desc.label);
    return built;
}

std::int64_t newest(const std::vector<std::string>& files) {
    std::int64_t stamp = 0;
    for (const std::string& file : files) stamp = std::max(stamp, asset_stamp(file));
    return stamp;
}

}  // namespace

ShaderText shader_text(const std::string& path,
                       const std::vector<std::pair<std::string, std::string>>& defines) {
    ShaderText out;
    out.text = "#version 450 core\n";
    for (const auto& [name, value] : defines) out.text += fmt::format("#define {} {}\n", name, value);
    append_file(path, out);
    return out;
}

Program::Program(ProgramDesc desc) : desc_(std::move(desc)) {
    Built built = build(desc_);
    name_ = built.name;
    files_ = std::move(built.files);
    stamp_ = newest(files_);
    was_cached_ = built.was_cached;
}

Program::~Program() {
    if (name_ != 0) glDeleteProgram(name_);
}

Program::Program(Program&& other) noexcept
    : desc_(std::move(other.desc_)),
      name_(std::exchange(other.name_, 0)),
      files_(std::move(other.files_)),
      stamp_(other.stamp_),
      was_cached_(other.was_cached_),
      locations_(std::move(other.locations_)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(desc_, other.desc_);
    std::swap(name_, other.name_);
    std::swap(files_, other.files_);
    std::swap(stamp_, other.stamp_);
    std::swap(was_cached_, other.was_cached_);
    std::swap(locations_, other.locations_);
    return *this;
}

void Program::dispatch(glm::uvec3 groups) const {
    use();
    glDispatchCompute(groups.x, groups.y, groups.z);
}

void Program::dispatch_for(glm::ivec3 items, glm::ivec3 local) const {
    dispatch(glm::uvec3((items + local - 1) / local));
}

GLint Program::location(const char* uniform) const {
    const auto found = locations_.find(uniform);
    if (found != locations_.end()) return found->second;
    const GLint index = glGetUniformLocation(name_, uniform);
    if (index < 0) fail("{}: the program has no active uniform {}", desc_.label, uniform);
    locations_.emplace(uniform, index);
    return index;
}

void Program::set(const char* u, int v) const {
    glProgramUniform1i(name_, location(u), v);
}
void Program::set(const char* u, std::uint32_t v) const {
    glProgramUniform1ui(name_, location(u), v);
}
void Program::set(const char* u, float v) const {
    glProgramUniform1f(name_, location(u), v);
}
void Program::set(const char* u, glm::ivec2 v) const {
    glProgramUniform2i(name_, location(u), v.x, v.y);
}
void Program::set(const char* u, glm::ivec3 v) const {
    glProgramUniform3i(name_, location(u), v.x, v.y, v.z);
}
void Program::set(const char* u, glm::uvec3 v) const {
    glProgramUniform3ui(name_, location(u), v.x, v.y, v.z);
}
void Program::set(const char* u, glm::vec2 v) const {
    glProgramUniform2f(name_, location(u), v.x, v.y);
}
void Program::set(const char* u, glm::vec3 v) const {
    glProgramUniform3f(name_, location(u), v.x, v.y, v.z);
}
void Program::set(const char* u, glm::vec4 v) const {
    glProgramUniform4f(name_, location(u), v.x, v.y, v.z, v.w);
}

std::optional<std::string> Program::poll_reload() {
    const std::int64_t stamp = newest(files_);
    if (stamp == stamp_) return std::nullopt;
    stamp_ = stamp;
    try {
        Built built = build(desc_);
        for (const auto& [uniform, location] : locations_) {
            if (glGetUniformLocation(built.name, uniform.c_str()) >= 0) continue;
            glDeleteProgram(built.name);
            fail("{}: the edited program has no active uniform {}", desc_.label, uniform);
        }
        glDeleteProgram(std::exchange(name_, built.name));
        files_ = std::move(built.files);
        was_cached_ = built.was_cached;
        locations_.clear();
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

}  // namespace tarn::gl
