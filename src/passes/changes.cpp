#include "passes/changes.h"

#include <array>
#include <bit>

#include "passes/work_list.h"

namespace tarn {

namespace {

constexpr std::size_t log_header_words = 2;     // of ChangeLog in glsl/lib/changes.glsl
constexpr std::size_t reader_words = 8;         // NewChanges of glsl/lib/new_changes.glsl
constexpr std::size_t reader_version_word = 7;  // new_changes_version
constexpr std::uint64_t changes_apart_max = std::uint64_t{1} << 31;

}  // namespace

ChangeLog::ChangeLog(glm::ivec3 size_bricks, std::uint32_t written)
    : bricks_(static_cast<std::uint32_t>(size_bricks.x * size_bricks.y * size_bricks.z)),
      capacity_(std::bit_ceil(bricks_)),
      entries_("change log", (log_header_words + capacity_) * word_bytes) {
    entries_.upload(std::array<std::uint32_t, log_header_words>{written, capacity_ - 1});
}

void ChangeLog::add_all() {
    std::uint32_t count = 0;
    entries_.download(std::span(&count, 1));
    count += capacity_ + 1;  // more than it holds: readers take every brick
    entries_.upload(std::span<const std::uint32_t>(&count, 1));
}

ChangeReader::ChangeReader()
    : program_({.label = "read changes", .compute = "pass/changes_read.comp"}),
      state_("new changes", reader_words * word_bytes) {}

void ChangeReader::read(const ChangeLog& log, std::uint32_t version) {
    // The count of changes is of 32 bits: whoever stayed away for too long begins anew.
    const std::uint64_t apart = std::uint64_t{version - seen_version_} * log.capacity();
    program_.set("restart", restart_ || apart >= changes_apart_max ? 1 : 0);
    program_.set("bricks", log.bricks());
    program_.set("version", version);
    log.bind();
    state_.bind_storage(STORAGE_NEW_CHANGES);
    program_.dispatch({1, 1, 1});
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    seen_version_ = version;
    restart_ = false;
    last_change_.reset();
}

void ChangeReader::run(const gl::Program& program, const ChangeLog& log) const {
    log.bind();
    state_.bind_storage(STORAGE_NEW_CHANGES);
    program.use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, state_.name());
    glDispatchComputeIndirect(0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

std::uint32_t ChangeReader::last_change() const {
    if (!last_change_) {
        std::uint32_t version = 0;
        state_.download(std::span(&version, 1), reader_version_word * word_bytes);
        last_change_ = version;
    }
    return *last_change_;
}

}  // namespace tarn
