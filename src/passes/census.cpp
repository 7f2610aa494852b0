#include "passes/census.h"

#include <array>

#include "core/error.h"
#include "passes/bricks.h"
#include "passes/work_list.h"
#include "shared/bindings.h"

namespace tarn {

namespace {

constexpr std::size_t bytes = 256;  // that a cell can hold

std::size_t tiles_of(glm::ivec3 size_vox) {
    const glm::ivec3 tiles = (size_vox + CENSUS_TILE - 1) / CENSUS_TILE;
    return std::size_t{1} * tiles.x * tiles.y * tiles.z;
}

}  // namespace

CensusPass::CensusPass(glm::ivec3 size_vox)
    : tiles_program_({.label = "census tiles", .compute = "pass/census_tiles.comp"}),
      count_program_({.label = "census", .compute = "pass/census.comp"}),
      counts_("cell counts", bytes * word_bytes),
      stale_tiles_("stale tiles", (empty_work_list.size() + tiles_of(size_vox)) * word_bytes),
      tile_listed_("tile listed", tiles_of(size_vox) * word_bytes),
      tile_counts_("tile counts", tiles_of(size_vox) * bytes * word_bytes),
      result_("cell counts, to be read", (bytes + 1) * word_bytes) {}

CensusPass::~CensusPass() {
    if (fence_ != nullptr) glDeleteSync(fence_);
}

void CensusPass::record(const Inputs& in, gl::Timers& timers) {
    CHECK(!pending());
    const auto scope = timers.scope("census");
    const ChangeLog& changes = in.activity.changes();
    reader_.read(changes, in.version);
    stale_tiles_.upload(empty_work_list);
    counts_.bind_storage(0);
    stale_tiles_.bind_storage(STORAGE_STALE_TILES);
    tile_listed_.bind_storage(STORAGE_TILE_LISTED);
    tile_counts_.bind_storage(STORAGE_TILE_COUNTS);
    in.cells.bind(BINDING_CELLS);
    tiles_program_.set("size_bricks", bricks_of(in.cells.size()));
    reader_.run(tiles_program_, changes);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    count_program_.use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, stale_tiles_.name());
    glDispatchComputeIndirect(0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glCopyNamedBufferSubData(counts_.name(), result_.name(), 0, 0, bytes * word_bytes);
    in.activity.copy_active_bricks(result_, bytes * word_bytes);
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

std::optional<CensusPass::Counts> CensusPass::take() {
    if (!pending()) return std::nullopt;
    const GLenum state = glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) return std::nullopt;
    glDeleteSync(fence_);
    fence_ = nullptr;
    std::array<std::uint32_t, bytes + 1> counts{};
    result_.download(std::span<std::uint32_t>(counts));
    Census census;
    for (std::uint32_t byte = 0; byte < bytes; ++byte) {
        census.voxels[material_of(byte)] += counts[byte];
        census.water_quanta += std::uint64_t{quanta_of(byte)} * counts[byte];
    }
    return Counts{census, counts[bytes]};
}

void CensusPass::poll_reload(std::vector<std::string>& messages) {
    if (auto message = reader_.poll_reload()) messages.push_back(*message);
    for (gl::Program* program : {&tiles_program_, &count_program_})
        if (auto message = program->poll_reload()) messages.push_back(*message);
}

}  // namespace tarn
