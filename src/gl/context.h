// What a current OpenGL context needs before use: the loader, the debug log, the limits. Owns no context.
#pragma once
#include <glad/gl.h>

#include <string>
#include <vector>

namespace tarn::gl {

// Loads OpenGL 4.5 core for the current context and installs the debug log. Throws Error naming the version
// found when it is older.
void load(GLADloadfunc get_proc);

// A context that shares the objects of the current one, for another thread. Made and destroyed on the thread
// of the first.
class SharedContext {
  public:
    virtual ~SharedContext() = default;
    // Both on the thread that uses it; release before destruction.
    virtual void make_current() = 0;
    virtual void release() = 0;
};
// Its messages go to the debug log too. It is current.
void watch_errors();

struct DriverInfo {
    std::string vendor, renderer, version;
};
DriverInfo driver_info();

// Messages of high severity (errors) since load(), of all contexts; tests demand none. glGetError's codes are
// added to it.
struct DebugLog {
    int high_severity = 0;
    std::vector<std::string> messages;  // the first 32
};
DebugLog debug_log();
void clear_debug_log();
// Adds pending glGetError codes to the log.
void collect_errors();

}  // namespace tarn::gl
