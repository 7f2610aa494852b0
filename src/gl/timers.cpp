#include "gl/timers.h"

#include <algorithm>
#include <string_view>

namespace tarn::gl {

Timers::Scope::Scope(Timers& timers, const char* name) : timers_(timers) {
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
    auto pass = std::find_if(timers.passes_.begin(), timers.passes_.end(),
                             [&](const PassTime& p) { return std::string_view(name) == p.name; });
    if (pass == timers.passes_.end()) {
        timers.passes_.push_back({.name = name});
        timers.frame_sum_ms_.push_back(0);
        pass = timers.passes_.end() - 1;
    }
    const GLuint begin = timers.take_query();
    end_query_ = timers.take_query();
    glQueryCounter(begin, GL_TIMESTAMP);
    timers.pending_.push_back(
        {static_cast<std::size_t>(pass - timers.passes_.begin()), begin, end_query_, timers.frame_});
}

Timers::Scope::~Scope() {
    glQueryCounter(end_query_, GL_TIMESTAMP);
    glPopDebugGroup();
}

Timers::~Timers() {
    for (const Pending& p : pending_) {
        free_.push_back(p.begin);
        free_.push_back(p.end);
    }
    if (!free_.empty()) glDeleteQueries(static_cast<GLsizei>(free_.size()), free_.data());
}

GLuint Timers::take_query() {
    if (free_.empty()) {
        free_.resize(16);
        glCreateQueries(GL_TIMESTAMP, static_cast<GLsizei>(free_.size()), free_.data());
    }
    const GLuint query = free_.back();
    free_.pop_back();
    return query;
}

void Timers::end_frame() {
    ++frame_;
    collect(false);
}

void Timers::finish() {
    collect(true);
}

void Timers::collect(bool wait) {
    const auto close_frame = [&] {
        for (std::size_t i = 0; i < passes_.size(); ++i) {
            PassTime& pass = passes_[i];
            if (frame_sum_ms_[i] <= 0) continue;
            pass.last_ms = frame_sum_ms_[i];
            pass.mean_ms =
                pass.frames == 0 ? pass.last_ms : pass.mean_ms + (pass.last_ms - pass.mean_ms) / 16;
            pass.total_ms += pass.last_ms;
            ++pass.frames;
            pass.last_frame = collecting_;
            frame_sum_ms_[i] = 0;
        }
        last_frame_ = collecting_;
    };
    std::size_t done = 0;
    for (; done < pending_.size(); ++done) {
        const Pending& p = pending_[done];
        GLuint available = 0;
        if (!wait) {
            glGetQueryObjectuiv(p.end, GL_QUERY_RESULT_AVAILABLE, &available);
            if (available == 0) break;
        }
        GLuint64 begin = 0;
        GLuint64 end = 0;
        glGetQueryObjectui64v(p.begin, GL_QUERY_RESULT, &begin);
        glGetQueryObjectui64v(p.end, GL_QUERY_RESULT, &end);
        if (p.frame != collecting_) {
            close_frame();
            collecting_ = p.frame;
        }
        if (end > begin) frame_sum_ms_[p.pass] += static_cast<double>(end - begin) * 1e-6;
        free_.push_back(p.begin);
        free_.push_back(p.end);
    }
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(done));
    if (wait) close_frame();
}

}  // namespace tarn::gl
