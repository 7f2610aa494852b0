// What a current OpenGL context needs before use: the loader, the debug log, the limits. Owns no context.
#pragma once
#include <glad/gl.h>

#include <string>
#include <vector>

namespace tarn::gl {

// Loads OpenGL 4.5 core for the current context and installs the debug log. Throws Error naming the version
// found when it is older.
void load(GLADloadfunc get_proc);

struct DriverInfo {
    std::string vendor, renderer, version;
};
DriverInfo driver_info();

// Messages of high severity (errors) since load(); tests demand none. glGetError's codes are added to it.
struct DebugLog {
    int high_severity = 0;
    std::vector<std::string> messages;  // the first 32
};
const DebugLog& debug_log();
void clear_debug_log();
// Adds pending glGetError codes to the log.
void collect_errors();

}  // namespace tarn::gl
