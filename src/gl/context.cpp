#include "gl/context.h"

#include <cstdlib>

#include "core/error.h"

namespace tarn::gl {

namespace {

// One context at a time per process (ARCHITECTURE: the platform owns it), so its log is process-wide.
DebugLog& log() {
    static DebugLog instance;
    return instance;
}

void record(const std::string& message) {
    ++log().high_severity;
    if (log().messages.size() < 32) log().messages.push_back(message);
}

void GLAD_API_PTR on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                             const GLchar* message, const void* /*user*/) {
    // Compile and link errors are reported with the whole log by Program.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    if (severity != GL_DEBUG_SEVERITY_HIGH && type != GL_DEBUG_TYPE_ERROR) return;
    record(fmt::format("GL message {:#x}: {}", id, std::string(message, static_cast<std::size_t>(length))));
    if (std::getenv("TARN_GL_DEBUG") != nullptr) fmt::print(stderr, "{}\n", log().messages.back());
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

}  // namespace

void load(GLADloadfunc get_proc) {
    const int version = gladLoadGL(get_proc);
    if (version == 0) fail("OpenGL: the driver gives no functions; an OpenGL 4.5 core driver is needed");
    if (version < GLAD_MAKE_VERSION(4, 5))
        fail("OpenGL: the driver gives {}.{}, 4.5 core is needed", GLAD_VERSION_MAJOR(version),
             GLAD_VERSION_MINOR(version));
    clear_debug_log();
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, nullptr);
}

DriverInfo driver_info() {
    return {gl_string(GL_VENDOR), gl_string(GL_RENDERER), gl_string(GL_VERSION)};
}

const DebugLog& debug_log() {
    return log();
}

void clear_debug_log() {
    log() = {};
}

void collect_errors() {
    for (GLenum code = glGetError(); code != GL_NO_ERROR; code = glGetError())
        record(fmt::format("GL error {:#x}", code));
}

}  // namespace tarn::gl
