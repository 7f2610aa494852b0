#include "passes/activity.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/error.h"
#include "passes/bricks.h"
#include "passes/work_list.h"
#include "shared/bindings.h"
#include "shared/water.h"

namespace tarn {

namespace {

struct GridUniforms {
    const char *block, *offset, *count;
};
constexpr std::array<GridUniforms, ActivityPass::grids_max> grid_uniforms{
    {{"block_vox[0]", "offset_vox[0]", "count_blocks[0]"},
     {"block_vox[1]", "offset_vox[1]", "count_blocks[1]"}}};

std::size_t volume(glm::ivec3 size) {
    return std::size_t{1} * size.x * size.y * size.z;
}

// Of 32 bricks along x (lib/matter.glsl).
struct MatterWord {
    std::uint32_t moves, room;
};
constexpr int bricks_per_word = 32;
glm::ivec3 words_of(glm::ivec3 size_bricks) {
    return {(size_bricks.x + bricks_per_word - 1) / bricks_per_word, size_bricks.y, size_bricks.z};
}

gl::Buffer work_list(const char* label, std::size_t items) {
    gl::Buffer list(label, (work_header_words + items) * word_bytes);
    list.upload(empty_work_list);
    return list;
}

void barrier() {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void dispatch_indirect(const gl::Program& program, const gl::Buffer& arguments) {
    program.use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, arguments.name());
    glDispatchComputeIndirect(0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    barrier();
}

}  // namespace

ActivityPass::ActivityPass(glm::ivec3 size_vox)
    : size_vox_(size_vox),
      size_bricks_(bricks_of(size_vox)),
      wake_({.label = "wake", .compute = "pass/activity_wake.comp"}),
      blocks_program_({.label = "blocks", .compute = "pass/activity_blocks.comp"}),
      all_blocks_program_(
          {.label = "all blocks", .compute = "pass/activity_blocks.comp", .defines = {{"ALL", "1"}}}),
      touch_({.label = "touch", .compute = "pass/activity_touch.comp"}),
      changed_tick_("changed tick", volume(size_bricks_) * word_bytes),
      lists_{work_list("active bricks a", volume(size_bricks_)),
             work_list("active bricks b", volume(size_bricks_))},
      changes_(size_bricks_),
      matter_("matter", sizeof(MatterWord) * volume(words_of(size_bricks_))) {}

void ActivityPass::wake_all(std::uint32_t tick) {
    const std::size_t bricks = volume(size_bricks_);
    changed_tick_.upload(std::vector<std::uint32_t>(bricks, tick - 1));
    const auto count = static_cast<std::uint32_t>(bricks);
    const std::uint32_t groups = (count + ACTIVE_PER_GROUP - 1) / ACTIVE_PER_GROUP;
    constexpr auto row = static_cast<std::uint32_t>(work_groups_per_row);
    std::vector<std::uint32_t> list{std::min(groups, row), (groups + row - 1) / row, 1, count};
    list.resize(work_header_words + bricks);
    std::iota(list.begin() + work_header_words, list.end(), 0u);
    lists_[next_].upload(list);
    woken_tick_ = tick;
}

void ActivityPass::sleep_all(std::uint32_t tick) {
    changed_tick_.upload(std::vector<std::uint32_t>(volume(size_bricks_), tick - SLEEP_TICKS - 2));
    lists_[next_].upload(empty_work_list);
    woken_tick_.reset();
}

void ActivityPass::touch(const std::vector<std::uint32_t>& bricks, std::uint32_t tick, std::uint32_t version,
                         const gl::Texture& brick_changed) {
    if (bricks.empty()) return;
    gl::Buffer touched("touched bricks", bricks.size() * word_bytes);
    touched.upload(bricks);
    touched.bind_storage(STORAGE_ACTIVE);
    bind(touch_, tick - 1);
    brick_changed.bind_image(IMAGE_BRICK_CHANGED, GL_READ_WRITE);
    touch_.set("version", version);
    touch_.set("count", static_cast<std::uint32_t>(bricks.size()));
    constexpr std::size_t row = 1024;
    const std::size_t groups = (bricks.size() + ACTIVE_PER_GROUP - 1) / ACTIVE_PER_GROUP;
    touch_.dispatch({std::min(groups, row), (groups + row - 1) / row, 1});
    barrier();
}

void ActivityPass::make_room_for(std::span<const BlockGrid> grids) {
    std::size_t marks = 0;
    bool grown = false;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        // For every offset.
        const BlockGrid widest{grids[i].block_vox, grids[i].block_vox - 1};
        const std::size_t blocks = volume(widest.count(size_vox_));
        marks += blocks;
        if (blocks <= blocks_capacity_[i]) continue;
        blocks_[i] = work_list("blocks", blocks);
        awake_blocks_[i] = work_list("awake blocks", blocks);
        blocks_capacity_[i] = blocks;
        grown = true;
    }
    if (grown)
        block_marks_ = gl::Buffer("block marks", (blocks_capacity_[0] + blocks_capacity_[1]) * word_bytes);
    CHECK(block_marks_.bytes() >= marks * word_bytes);
}

void ActivityPass::begin_tick(std::uint32_t tick, std::span<const BlockGrid> grids) {
    CHECK(!grids.empty() && grids.size() <= grids_max);
    make_room_for(grids);
    std::copy(grids.begin(), grids.end(), grids_.begin());
    // The list of active bricks is that of all, and stays so.
    if (all_awake(tick)) return;
    woken_tick_.reset();

    const gl::Buffer& active = next();
    next_ = 1 - next_;
    lists_[next_].upload(empty_work_list);
    if (++mark_ == 0) {
        block_marks_.clear();
        mark_ = 1;
    }
    for (std::size_t i = 0; i < grids.size(); ++i) {
        const GridUniforms& names = grid_uniforms[i];
        wake_.set(names.block, grids[i].block_vox);
        wake_.set(names.offset, grids[i].offset_vox);
        wake_.set(names.count, grids[i].count(size_vox_));
        awake_blocks_[i].upload(empty_work_list);
        awake_blocks_[i].bind_storage(i == 0 ? STORAGE_AWAKE_BLOCKS : STORAGE_AWAKE_BLOCKS_WIDE);
    }
    wake_.set("size_vox", size_vox_);
    wake_.set("size_bricks", size_bricks_);
    wake_.set("grids", static_cast<int>(grids.size()));
    wake_.set("tick", tick);
    wake_.set("mark", mark_);
    active.bind_storage(STORAGE_ACTIVE);
    next().bind_storage(STORAGE_ACTIVE_NEXT);
    changed_tick_.bind_storage(STORAGE_CHANGED_TICK);
    block_marks_.bind_storage(STORAGE_BLOCK_MARKS);
    dispatch_indirect(wake_, active);
}

void ActivityPass::list_blocks(std::size_t grid, std::uint32_t tick) {
    const bool all = all_awake(tick);
    const gl::Program& program = all ? all_blocks_program_ : blocks_program_;
    program.set("block_vox", grids_[grid].block_vox);
    program.set("offset_vox", grids_[grid].offset_vox);
    program.set("count_blocks", grids_[grid].count(size_vox_));
    program.set("size_vox", size_vox_);
    blocks_[grid].upload(empty_work_list);
    blocks_[grid].bind_storage(STORAGE_BLOCKS);
    matter_.bind_storage(STORAGE_MATTER);
    if (!all) {
        awake_blocks_[grid].bind_storage(STORAGE_AWAKE_BLOCKS);
        dispatch_indirect(program, awake_blocks_[grid]);
        return;
    }
    const std::size_t groups =
        (volume(grids_[grid].count(size_vox_)) + ACTIVE_PER_GROUP - 1) / ACTIVE_PER_GROUP;
    program.dispatch(
        {std::min(groups, work_groups_per_row), (groups + work_groups_per_row - 1) / work_groups_per_row, 1});
    barrier();
}

void ActivityPass::bind(const gl::Program& program, std::uint32_t tick) const {
    program.set("size_bricks", size_bricks_);
    program.set("tick", tick);
    changed_tick_.bind_storage(STORAGE_CHANGED_TICK);
    next().bind_storage(STORAGE_ACTIVE_NEXT);
    changes_.bind();
    matter_.bind_storage(STORAGE_MATTER);
}

void ActivityPass::run_blocks(const gl::Program& program, std::size_t grid, std::uint32_t tick) {
    list_blocks(grid, tick);
    bind(program, tick);
    blocks_[grid].bind_storage(STORAGE_BLOCKS);
    dispatch_indirect(program, blocks_[grid]);
}

std::uint32_t ActivityPass::active_bricks() const {
    std::uint32_t count = 0;
    next().download(std::span(&count, 1), (work_header_words - 1) * word_bytes);
    return count;
}

void ActivityPass::copy_active_bricks(const gl::Buffer& to, std::size_t offset_bytes) const {
    glCopyNamedBufferSubData(next().name(), to.name(),
                             static_cast<GLintptr>((work_header_words - 1) * word_bytes),
                             static_cast<GLintptr>(offset_bytes), word_bytes);
}

void ActivityPass::poll_reload(std::vector<std::string>& messages) {
    for (gl::Program* program : {&wake_, &blocks_program_, &all_blocks_program_, &touch_})
        if (auto message = program->poll_reload()) messages.push_back(*message);
}

}  // namespace tarn
