// What lies under a pixel or along a ray: a picture of one ray, apart from the frames.
#include "app/camera.h"
#include "app/frame_block.h"
#include "app/renderer_parts.h"
#include "shared/bindings.h"

namespace tarn {

Pick Renderer::pick(const Simulation& simulation, const Settings& settings, glm::ivec2 size_px,
                    glm::vec2 at_px, bool through_water) {
    return pick_along(simulation, settings, View(settings, size_px).dir_through(at_px), through_water);
}

Pick Renderer::pick_along(const Simulation& simulation, const Settings& settings, glm::vec3 dir,
                          bool through_water) {
    Parts& p = *parts_;
    const FrameBlock block = make_frame_block({.settings = settings,
                                               .world_size_vox = simulation.size_vox(),
                                               .metres_per_voxel = p.metres_per_voxel,
                                               .seed = p.seed,
                                               .frame_index = 0,
                                               .frames_kept = 0,
                                               .traced_px = glm::ivec2(1),
                                               .shown_px = glm::ivec2(1)});
    p.frame_block.upload(std::span(&block, 1));
    p.frame_block.bind_uniform(BINDING_FRAME);
    const PickPass::Result result = p.built(p.pick[through_water], through_water)
                                        .record({.cells = simulation.cells(), .dir = dir}, p.timers);
    return {.hit = result.cell.w != 0,
            .cell = glm::ivec3(result.cell),
            .normal = glm::ivec3(result.normal),
            .byte = static_cast<std::uint8_t>(result.normal.w)};
}

}  // namespace tarn
