#include "passes/flow.h"

#include "shared/bindings.h"
#include "world/schedule.h"

namespace tarn {

FlowPass::FlowPass(const Counts& start)
    : spring_({.label = "spring", .compute = "pass/flow.comp", .defines = {{"SPRING", "1"}}}),
      drain_({.label = "drain", .compute = "pass/flow.comp"}),
      counters_("flow counters", 8 * sizeof(std::uint32_t)) {
    std::vector<std::uint32_t> raw;
    for (const std::uint64_t count : {start.sprung_water_quanta, start.drained_water_quanta,
                                      start.sprung_sand_voxels, start.drained_sand_voxels}) {
        raw.push_back(static_cast<std::uint32_t>(count));
        raw.push_back(static_cast<std::uint32_t>(count >> 32));
    }
    counters_.upload(std::span<const std::uint32_t>(raw));
}

void FlowPass::record_springs(const std::vector<Spring>& springs, const Inputs& in,
                              const Outputs& out) const {
    for (std::uint32_t i = 0; i < springs.size(); ++i) {
        const Box region = clipped(springs[i].region, out.cells.size());
        if (region.volume() == 0 || springs[i].per_tick == 0) continue;
        const SpringShare share = spring_share(springs[i].per_tick, region.volume(), in.seed, in.tick, i);
        spring_.set("makes_sand", springs[i].material == MATERIAL_SAND ? 1 : 0);
        spring_.set("base", share.base);
        spring_.set("rest_stride_phase", glm::uvec3(share.rest, share.stride, share.phase));
        dispatch(spring_, region, in, out);
    }
}

void FlowPass::record_drains(const std::vector<Drain>& drains, const Inputs& in, const Outputs& out) const {
    for (const Drain& drain : drains) {
        const Box region = clipped(drain.region, out.cells.size());
        if (region.volume() > 0) dispatch(drain_, region, in, out);
    }
}

void FlowPass::dispatch(const gl::Program& program, const Box& region, const Inputs& in,
                        const Outputs& out) const {
    program.set("region_min_vox", region.min_vox);
    program.set("region_size_vox", region.size());
    program.set("version", in.version);
    in.activity.bind(program, in.tick);
    out.cells.bind_image(IMAGE_CELLS, GL_READ_WRITE);
    out.brick_changed.bind_image(IMAGE_BRICK_CHANGED, GL_READ_WRITE);
    counters_.bind_storage(0);
    program.dispatch_for(region.size(), {8, 4, 8});
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);
}

FlowPass::Counts FlowPass::counts() const {
    std::array<std::uint32_t, 8> raw{};
    counters_.download(std::span<std::uint32_t>(raw));
    const auto wide = [&](std::size_t i) { return raw[2 * i] | std::uint64_t{raw[2 * i + 1]} << 32; };
    return {wide(0), wide(1), wide(2), wide(3)};
}

void FlowPass::poll_reload(std::vector<std::string>& messages) {
    for (gl::Program* program : {&spring_, &drain_})
        if (auto message = program->poll_reload()) messages.push_back(*message);
}

}  // namespace tarn
