#include "passes/bricks.h"

#include <array>

#include "shared/bindings.h"

namespace tarn {

namespace {

constexpr glm::ivec3 local_size{8, 8, 1};

gl::Program distance_program(const char* axis, bool first) {
    return gl::Program({.label = "brick distance",
                        .compute = "pass/brick_distance.comp",
                        .defines = {{"AXIS", axis}, {"FIRST", first ? "1" : "0"}}});
}

}  // namespace

glm::ivec3 bricks_of(glm::ivec3 size_vox) {
    return (size_vox + BRICK_SIDE - 1) / BRICK_SIDE;
}

BricksPass::BricksPass(glm::ivec3 size_bricks)
    : occupancy_program_({.label = "brick occupancy", .compute = "pass/brick_occupancy.comp"}),
      // Up and down first: from the open sky the ground is found there, and bounds the searches after.
      distance_program_{distance_program("1", true), distance_program("0", false),
                        distance_program("2", false)},
      occupancy_({.label = "brick occupancy", .format = GL_RG8UI, .size = size_bricks}),
      between_({.label = "brick distance, between axes", .format = GL_RG8UI, .size = size_bricks}),
      last_change_("last change", sizeof(std::uint32_t)),
      groups_("brick distance groups", 3 * sizeof(std::uint32_t)) {
    // A value that no brick has: the first call computes every distance.
    constexpr std::array<std::uint8_t, 2> unknown{255, 255};
    glClearTexImage(occupancy_.name(), 0, GL_RG_INTEGER, GL_UNSIGNED_BYTE, unknown.data());
}

void BricksPass::record(const Inputs& in, const Outputs& out, gl::Timers& timers) const {
    const glm::ivec3 size_bricks = occupancy_.size();
    {
        const auto scope = timers.scope("bricks");
        groups_.clear();
        groups_.bind_storage(0);
        last_change_.bind_storage(1);
        in.cells.bind(BINDING_CELLS);
        in.brick_changed.bind_image(0, GL_READ_ONLY);
        occupancy_.bind_image(1, GL_READ_WRITE);
        occupancy_program_.set("size_bricks", size_bricks);
        occupancy_program_.set("distance_groups", glm::uvec3((size_bricks + local_size - 1) / local_size));
        occupancy_program_.set("version", in.version);
        occupancy_program_.dispatch_for(size_bricks, local_size);
        glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                        GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    }
    const auto scope = timers.scope("distance");
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, groups_.name());
    const gl::Texture* source = &occupancy_;
    for (int i = 0; i < 3; ++i) {
        const gl::Texture& target = i == 1 ? between_ : out.brick_distance;
        const gl::Program& program = distance_program_[i];
        program.set("size_bricks", size_bricks);
        source->bind(BINDING_FIRST_INPUT);
        target.bind_image(0, GL_WRITE_ONLY);
        program.use();
        glDispatchComputeIndirect(0);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        source = &target;
    }
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

std::uint32_t BricksPass::last_change() const {
    std::uint32_t version = 0;
    last_change_.download(std::span(&version, 1));
    return version;
}

void BricksPass::poll_reload(std::vector<std::string>& messages) {
    for (gl::Program* program :
         {&occupancy_program_, &distance_program_[0], &distance_program_[1], &distance_program_[2]})
        if (auto message = program->poll_reload()) messages.push_back(*message);
}

}  // namespace tarn
