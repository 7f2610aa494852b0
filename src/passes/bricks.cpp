#include "passes/bricks.h"

#include <array>

#include "shared/bindings.h"
#include "shared/rooms.h"

namespace tarn {

namespace {

gl::Program rooms_program(const char* axis) {
    return gl::Program(
        {.label = "brick rooms", .compute = "pass/brick_rooms.comp", .defines = {{"AXIS", axis}}});
}

void fill(const gl::Texture& texture, GLenum layout, std::array<std::uint8_t, 2> value) {
    glClearTexImage(texture.name(), 0, layout, GL_UNSIGNED_BYTE, value.data());
}

std::size_t line_bytes(glm::ivec3 size) {
    const std::size_t words = std::size_t{1} * room_line_words(1) * size.x * size.z +
                              std::size_t{1} * room_line_words(0) * size.y * size.z +
                              std::size_t{1} * room_line_words(2) * size.x * size.y;
    return words * sizeof(std::uint32_t);
}

}  // namespace

glm::ivec3 bricks_of(glm::ivec3 size_vox) {
    return (size_vox + BRICK_SIDE - 1) / BRICK_SIDE;
}

BricksPass::BricksPass(glm::ivec3 size_bricks)
    : occupancy_program_({.label = "brick occupancy", .compute = "pass/brick_occupancy.comp"}),
      rooms_program_{rooms_program("0"), rooms_program("1"), rooms_program("2")},
      occupancy_({.label = "brick occupancy", .format = GL_RG8UI, .size = size_bricks}),
      rooms_up_({.label = "brick rooms along y", .format = GL_R8UI, .size = rooms_size(size_bricks)}),
      rooms_side_(
          {.label = "brick rooms along y and x", .format = GL_R16UI, .size = rooms_size(size_bricks)}),
      groups_("brick room groups", 3 * sizeof(glm::uvec3)),
      lines_("lines of bricks", line_bytes(size_bricks)) {
    // No brick is clear: what the first call finds is a change from that.
    fill(occupancy_, GL_RG_INTEGER, {1, 1});
    for (const gl::Texture* texture : {&rooms_up_, &rooms_side_}) fill(*texture, GL_RED_INTEGER, {0, 0});
}

void BricksPass::record(const Inputs& in, const Outputs& out, gl::Timers& timers) {
    const glm::ivec3 size_bricks = occupancy_.size();
    const auto scope = timers.scope("bricks");
    reader_.read(in.activity.changes(), in.version);
    groups_.clear();
    in.activity.matter().bind_storage(STORAGE_MATTER);
    groups_.bind_storage(STORAGE_ROOM_GROUPS);
    lines_.bind_storage(STORAGE_ROOM_LINES);
    in.cells.bind_image(2, GL_READ_ONLY);
    occupancy_.bind_image(0, GL_READ_WRITE);
    out.brick_rooms.bind_image(1, GL_WRITE_ONLY);
    occupancy_program_.set("size_bricks", size_bricks);
    constexpr int side = 8;  // of a group of brick_rooms.comp
    constexpr int run = side * ROOM_LINES_AN_INVOCATION;
    occupancy_program_.set("line_groups", glm::uvec3((size_bricks + side - 1) / side));
    occupancy_program_.set("run_groups", glm::uvec3((size_bricks + run - 1) / run));
    reader_.run(occupancy_program_, in.activity.changes());
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, groups_.name());
    struct Step {
        int axis;
        const gl::Texture &source, &target;
    };
    for (const Step& step : {Step{1, occupancy_, rooms_up_}, Step{0, rooms_up_, rooms_side_},
                             Step{2, rooms_side_, out.brick_rooms}}) {
        const gl::Program& program = rooms_program_[step.axis];
        program.set("size_bricks", size_bricks);
        step.source.bind_image(1, GL_READ_ONLY);
        step.target.bind_image(0, GL_READ_WRITE);
        program.use();
        glDispatchComputeIndirect(static_cast<GLintptr>(sizeof(glm::uvec3)) * step.axis);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                        GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

void BricksPass::poll_reload(std::vector<std::string>& messages) {
    if (auto message = reader_.poll_reload()) messages.push_back(*message);
    for (gl::Program* program :
         {&occupancy_program_, &rooms_program_[0], &rooms_program_[1], &rooms_program_[2]})
        if (auto message = program->poll_reload()) messages.push_back(*message);
}

}  // namespace tarn
