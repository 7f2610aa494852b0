#include "passes/level_step.h"

#include "shared/bindings.h"
#include "shared/hash.h"
#include "shared/water.h"
#include "world/schedule.h"

namespace tarn {

std::array<BlockGrid, 2> LevelStepPass::grids(std::uint32_t seed, std::uint32_t tick) {
    constexpr glm::ivec3 tall(TALL_SIDE, TALL_HEIGHT, TALL_SIDE);
    constexpr glm::ivec3 wide(WIDE_SIDE, WIDE_HEIGHT, WIDE_SIDE);
    return {BlockGrid{tall, block_offset_vox(seed, tick, tall)},
            BlockGrid{wide, block_offset_vox(seed ^ SALT_WIDE, tick, wide)}};
}

const LevelStepPass::Programs& LevelStepPass::programs(bool pressure) {
    std::optional<Programs>& wanted = pressure ? pressure_ : level_;
    if (!wanted) {
        std::vector<std::pair<std::string, std::string>> defines;
        if (pressure) defines.emplace_back("PRESSURE", "1");
        wanted = Programs{
            gl::Program({.label = "level tall", .compute = "pass/level_tall.comp", .defines = defines}),
            gl::Program({.label = "level wide", .compute = "pass/level_wide.comp", .defines = defines})};
    }
    return *wanted;
}

void LevelStepPass::record(const Inputs& in, const Outputs& out) {
    const Programs& run = programs(out.acting_head != nullptr);
    const glm::ivec3 size_vox = out.cells.size();
    const std::array<BlockGrid, 2> of_tick = grids(in.seed, in.tick);
    out.cells.bind_image(IMAGE_CELLS, GL_READ_WRITE);
    out.brick_changed.bind_image(IMAGE_BRICK_CHANGED, GL_READ_WRITE);
    if (out.acting_head != nullptr) out.acting_head->bind_image(IMAGE_ACTING_HEAD, GL_READ_WRITE);
    run.tall.set("diagonal", hash2(in.seed ^ SALT_DIAGONAL, in.tick) % 3 == 0 ? 1 : 0);
    for (std::size_t grid = 0; grid < 2; ++grid) {
        const gl::Program& program = grid == 0 ? run.tall : run.wide;
        program.set("size_vox", size_vox);
        program.set("offset_vox", of_tick[grid].offset_vox);
        program.set("count_blocks", of_tick[grid].count(size_vox));
        program.set("seed", grid == 0 ? in.seed : in.seed ^ SALT_WIDE);
        program.set("film_threshold", in.film_threshold);
        program.set("version", in.version);
        in.activity.run_blocks(program, grid, in.tick);
    }
}

void LevelStepPass::poll_reload(std::vector<std::string>& messages) {
    for (std::optional<Programs>* made : {&level_, &pressure_}) {
        if (!*made) continue;
        for (gl::Program* program : {&(*made)->tall, &(*made)->wide})
            if (auto message = program->poll_reload()) messages.push_back(*message);
    }
}

}  // namespace tarn
