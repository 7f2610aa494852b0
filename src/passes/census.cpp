#include "passes/census.h"

#include <array>

#include "core/error.h"
#include "shared/bindings.h"

namespace tarn {

namespace {

constexpr std::size_t bytes = 256;  // that a cell can hold

}  // namespace

CensusPass::CensusPass()
    : program_({.label = "census", .compute = "pass/census.comp"}),
      counts_("cell counts", (bytes + 1) * sizeof(std::uint32_t)) {}

CensusPass::~CensusPass() {
    if (fence_ != nullptr) glDeleteSync(fence_);
}

void CensusPass::record(const gl::Texture& cells, const ActivityPass& activity, gl::Timers& timers) {
    CHECK(!pending());
    const auto scope = timers.scope("census");
    counts_.clear();
    counts_.bind_storage(0);
    cells.bind(BINDING_CELLS);
    program_.dispatch_for(cells.size(), {8, 32, 8});
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    activity.copy_active_bricks(counts_, bytes * sizeof(std::uint32_t));
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

std::optional<CensusPass::Counts> CensusPass::take() {
    if (!pending()) return std::nullopt;
    const GLenum state = glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) return std::nullopt;
    glDeleteSync(fence_);
    fence_ = nullptr;
    std::array<std::uint32_t, bytes + 1> counts{};
    counts_.download(std::span<std::uint32_t>(counts));
    Census census;
    for (std::uint32_t byte = 0; byte < bytes; ++byte) {
        census.voxels[material_of(byte)] += counts[byte];
        census.water_quanta += std::uint64_t{quanta_of(byte)} * counts[byte];
    }
    return Counts{census, counts[bytes]};
}

}  // namespace tarn
