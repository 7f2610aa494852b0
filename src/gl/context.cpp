#include "gl/context.h"

#include <cstdlib>
#include <mutex>

#include "core/error.h"

namespace tarn::gl {

namespace {

// One context at a time per process (ARCHITECTURE: the platform owns it) and those that share with it, so the
// log is process-wide.
struct SharedLog {
    std::mutex mutex;
    DebugLog log;
};
SharedLog& shared() {
    static SharedLog instance;
    return instance;
}

void record(const std::string& message) {
    const std::scoped_lock lock(shared().mutex);
    DebugLog& log = shared().log;
    ++log.high_severity;
    if (log.messages.size() < 32) log.messages.push_back(message);
    if (std::getenv("TARN_GL_DEBUG") != nullptr) fmt::print(stderr, "{}\n", message);
}

void GLAD_API_PTR on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                             const GLchar* message, const void* /*user*/) {
    // Compile and link errors are reported with the whole log by Program.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    if (severity != GL_DEBUG_SEVERITY_HIGH && type != GL_DEBUG_TYPE_ERROR) return;
    record(fmt::format("GL message {:#x}: {}", id, std::string(message, static_cast<std::size_t>(length))));
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
    watch_errors();
}

void watch_errors() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, nullptr);
}

DriverInfo driver_info() {
    return {gl_string(GL_VENDOR), gl_string(GL_RENDERER), gl_string(GL_VERSION)};
}

DebugLog debug_log() {
    const std::scoped_lock lock(shared().mutex);
    return shared().log;
}

void clear_debug_log() {
    const std::scoped_lock lock(shared().mutex);
    shared().log = {};
}

void collect_errors() {
    for (GLenum code = glGetError(); code != GL_NO_ERROR; code = glGetError())
        record(fmt::format("GL error {:#x}", code));
}

}  // namespace tarn::gl
