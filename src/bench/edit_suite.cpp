// What a stroke of the brush costs, until rays and water can use the world again, beside a frame of it.
#include <fmt/format.h>

#include <memory>

#include "app/renderer.h"
#include "app/stopwatch.h"
#include "bench/bench_suites.h"

namespace tarn {

namespace {

constexpr glm::ivec2 frame_size_px{640, 360};
constexpr int radii_vox[] = {1, 8, 32};

// Places a ball of stone in the air over the middle, or takes it away: the next stroke finds what the first
// did.
class Stroke {
  public:
    Stroke(BenchWorld& world, int radius_vox) : world_(world) {
        const glm::ivec3 size = world.simulation.size_vox();
        edit_ = {.tick = 0,
                 .shape = BrushShape::Sphere,
                 .center_vox = {size.x / 2, size.y * 3 / 4, size.z / 2},
                 .radius_vox = radius_vox,
                 .material = MATERIAL_AIR,
                 .overwrite = false};
    }
    double run() {
        edit_.material = edit_.material == MATERIAL_STONE ? MATERIAL_AIR : MATERIAL_STONE;
        edit_.tick = world_.simulation.tick();
        history_.begin_stroke();
        glFinish();
        const Stopwatch watch;
        world_.simulation.apply(edit_, history_);
        glFinish();
        const double ms = watch.ms();
        world_.timers.end_frame();
        world_.timers.finish();
        return ms;
    }

  private:
    BenchWorld& world_;
    Edit edit_;
    EditHistory history_;
};

void measure_world(int side_vox, const BenchOptions& options, BenchResult& result) {
    const std::string scene = bench_scene_name(side_vox);
    options.progress(fmt::format("edit: building {}", scene));
    const auto world = make_bench_world(side_vox);
    std::vector<std::unique_ptr<Stroke>> strokes;
    std::vector<Contestant> contestants;
    for (const int radius : radii_vox) {
        Stroke* const stroke = strokes.emplace_back(std::make_unique<Stroke>(*world, radius)).get();
        contestants.push_back(
            {.suite = "edit", .scene = scene, .who = fmt::format("radius {}", radius), .run = [stroke] {
                 // One that places and one that removes.
                 const double ms = (stroke->run() + stroke->run()) / 2;
                 return std::vector<Sample>{{"stroke", "ms", ms}};
             }});
    }
    gl::Timers timers;
    Renderer renderer(world->scene, timers);
    contestants.push_back({.suite = "edit", .scene = scene, .who = "balanced", .run = [&] {
                               glFinish();
                               const Stopwatch watch;
                               renderer.render(world->simulation, world->scene.settings, frame_size_px);
                               glFinish();
                               const double ms = watch.ms();
                               timers.end_frame();
                               timers.finish();
                               return std::vector<Sample>{{"frame 640x360", "ms", ms}};
                           }});
    run_rounds(contestants, {.rounds = options.rounds}, result.figures, options.progress);
}

}  // namespace

void run_edit_suite(const BenchOptions& options, BenchResult& result) {
    for (const int side : options.sides_vox) measure_world(side, options, result);
}

}  // namespace tarn
