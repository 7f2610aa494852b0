#include "passes/emitters.h"

#include "core/error.h"
#include "shared/bindings.h"

namespace tarn {

EmitterTreeHead emitter_tree_head(glm::ivec3 size_bricks) {
    EmitterTreeHead head;
    int first = 0;
    for (glm::ivec3 size = size_bricks;; size = (size + 1) / 2) {
        CHECK(head.depth.x < EMITTER_LEVELS_MAX);
        head.levels[head.depth.x++] = glm::ivec4(size, first);
        first += size.x * size.y * size.z;
        if (size == glm::ivec3(1)) return head;
    }
}

std::size_t emitter_node_count(const EmitterTreeHead& head) {
    return static_cast<std::size_t>(head.levels[head.depth.x - 1].w) + 1;
}

EmittersPass::EmittersPass(glm::ivec3 size_bricks)
    : head_(emitter_tree_head(size_bricks)),
      bricks_program_({.label = "emitter bricks", .compute = "pass/emitter_bricks.comp"}),
      tree_program_({.label = "emitter tree", .compute = "pass/emitter_tree.comp"}),
      tree_("emitter tree", sizeof(EmitterTreeHead) + sizeof(float) * emitter_node_count(head_)),
      masks_("emitter masks", sizeof(glm::uvec2) * size_bricks.x * size_bricks.y * size_bricks.z),
      groups_("emitter tree groups", sizeof(glm::uvec3) * EMITTER_LEVELS_MAX) {
    tree_.upload(std::span(&head_, 1));
}

void EmittersPass::record(const Inputs& in, gl::Timers& timers) {
    if (seen_any_ && in.version == seen_version_) return;
    const auto scope = timers.scope("emitters");
    reader_.read(in.changes, in.version);
    groups_.clear();
    bind();
    groups_.bind_storage(STORAGE_EMITTER_GROUPS);
    in.cells.bind(BINDING_CELLS);
    reader_.run(bricks_program_, in.changes);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, groups_.name());
    for (int level = 1; level < head_.depth.x; ++level) {
        glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
        tree_program_.set("level", level);
        tree_program_.use();
        glDispatchComputeIndirect(static_cast<GLintptr>(sizeof(glm::uvec3)) * level);
    }
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    seen_version_ = in.version;
    seen_any_ = true;
}

void EmittersPass::bind() const {
    tree_.bind_storage(STORAGE_EMITTER_TREE);
    masks_.bind_storage(STORAGE_EMITTER_MASKS);
}

void EmittersPass::poll_reload(std::vector<std::string>& messages) {
    if (auto message = reader_.poll_reload()) messages.push_back(*message);
    for (gl::Program* program : {&bricks_program_, &tree_program_})
        if (auto message = program->poll_reload()) {
            messages.push_back(*message);
            tree_.clear();
            tree_.upload(std::span(&head_, 1));
            masks_.clear();
            reader_.restart();
            seen_any_ = false;
        }
}

}  // namespace tarn
