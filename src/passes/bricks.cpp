#include "passes/bricks.h"

#include <array>
#include <limits>

#include "shared/bindings.h"

namespace tarn {

namespace {

// Up and down first: from the open sky the ground is found there, which leaves the others little to do.
constexpr std::array<const char*, 3> axes{"1", "0", "2"};
constexpr std::array<GLuint, 3> axis_numbers{1, 0, 2};
constexpr std::size_t box_bytes = 12 * sizeof(std::uint32_t);  // DistanceBox of glsl/lib/distance_boxes.glsl
constexpr std::size_t groups_offset = 8 * sizeof(std::uint32_t);
constexpr int highest = std::numeric_limits<int>::max();
constexpr std::array<int, 8> nowhere{highest, highest, highest, 0, -1, -1, -1, 0};

gl::Program distance_program(std::size_t step) {
    return gl::Program({.label = "brick distance",
                        .compute = "pass/brick_distance.comp",
                        .defines = {{"AXIS", axes[step]}, {"FIRST", step == 0 ? "1" : "0"}}});
}

}  // namespace

glm::ivec3 bricks_of(glm::ivec3 size_vox) {
    return (size_vox + BRICK_SIDE - 1) / BRICK_SIDE;
}

BricksPass::BricksPass(glm::ivec3 size_bricks)
    : occupancy_program_({.label = "brick occupancy", .compute = "pass/brick_occupancy.comp"}),
      boxes_program_({.label = "brick boxes", .compute = "pass/brick_boxes.comp"}),
      distance_program_{distance_program(0), distance_program(1), distance_program(2)},
      occupancy_({.label = "brick occupancy", .format = GL_RG8UI, .size = size_bricks}),
      between_{gl::Texture({.label = "brick distance, one axis", .format = GL_RG8UI, .size = size_bricks}),
               gl::Texture({.label = "brick distance, two axes", .format = GL_RG8UI, .size = size_bricks})},
      flips_("brick flips", sizeof(nowhere)),
      boxes_("brick distance boxes", 3 * box_bytes) {
    // A value that no brick has: the first call computes every distance.
    constexpr std::array<std::uint8_t, 2> unknown{255, 255};
    glClearTexImage(occupancy_.name(), 0, GL_RG_INTEGER, GL_UNSIGNED_BYTE, unknown.data());
    flips_.upload(nowhere);
}

void BricksPass::record(const Inputs& in, const Outputs& out, gl::Timers& timers) {
    const glm::ivec3 size_bricks = occupancy_.size();
    const auto scope = timers.scope("bricks");
    reader_.read(in.activity.changes(), in.version);
    in.activity.matter().bind_storage(STORAGE_MATTER);
    flips_.bind_storage(STORAGE_BRICK_FLIPS);
    boxes_.bind_storage(STORAGE_DISTANCE_BOXES);
    in.cells.bind(BINDING_CELLS);
    occupancy_.bind_image(0, GL_READ_WRITE);
    occupancy_program_.set("size_bricks", size_bricks);
    reader_.run(occupancy_program_, in.activity.changes());
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    boxes_program_.set("size_bricks", size_bricks);
    boxes_program_.dispatch({1, 1, 1});
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, boxes_.name());
    const std::array<const gl::Texture*, 4> stages{&occupancy_, &between_[0], &between_[1],
                                                   &out.brick_distance};
    for (std::size_t i = 0; i < 3; ++i) {
        const gl::Program& program = distance_program_[i];
        program.set("size_bricks", size_bricks);
        stages[i]->bind(BINDING_FIRST_INPUT);
        stages[i + 1]->bind_image(0, GL_READ_WRITE);
        program.use();
        glDispatchComputeIndirect(static_cast<GLintptr>(axis_numbers[i] * box_bytes + groups_offset));
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

void BricksPass::poll_reload(std::vector<std::string>& messages) {
    if (auto message = reader_.poll_reload()) messages.push_back(*message);
    for (gl::Program* program : {&occupancy_program_, &boxes_program_, &distance_program_[0],
                                 &distance_program_[1], &distance_program_[2]})
        if (auto message = program->poll_reload()) messages.push_back(*message);
}

}  // namespace tarn
