// Frames of every quality, by pass, beside Embree's primary rays of the same picture.
#include <fmt/format.h>

#include <map>
#include <memory>

#include "app/renderer.h"
#include "app/stopwatch.h"
#include "bench/bench_suites.h"
#include "bench/embree_scene.h"

namespace tarn {

namespace {

constexpr double rays_least_ms = 200;  // as long as a frame, about
// A game has a history, and few pixels that are new to it: so many frames come before the timed ones, or as
// many as fit.
constexpr int history_frames = 16;
constexpr double history_ms_max = 5000;

// One quality of one scene.
class FrameCase {
  public:
    FrameCase(const BenchWorld& world, Quality quality)
        : simulation_(world.simulation), settings_(world.scene.settings), renderer_(world.scene, timers_) {
        apply_quality(settings_, quality);
        settings_.refine_at_rest = false;  // later frames would be those of exact
    }

    // The time of a frame, and of its passes.
    std::vector<Sample> run(glm::ivec2 size_px) {
        if (size_px != size_px_) begin(size_px);
        std::map<std::string, long> frames_before;
        for (const gl::PassTime& pass : timers_.passes()) frames_before[pass.name] = pass.frames;
        glFinish();
        const Stopwatch watch;
        renderer_.render(simulation_, settings_, size_px);
        glFinish();
        const std::string what = fmt::format("frame {}x{}", size_px.x, size_px.y);
        std::vector<Sample> samples{{what, "ms", watch.ms()}};
        timers_.end_frame();
        timers_.finish();
        for (const gl::PassTime& pass : timers_.passes())
            if (pass.frames > frames_before[pass.name])
                samples.push_back({what + ": " + pass.name, "ms", pass.last_ms});
        return samples;
    }
    // With the compilation of its programs, as far as the driver's cache does not hold them.
    double first_frame_ms() const { return first_frame_ms_; }

  private:
    void begin(glm::ivec2 size_px) {
        size_px_ = size_px;
        const Stopwatch watch;
        for (int i = 0; i < history_frames && watch.ms() < history_ms_max; ++i) {
            renderer_.render(simulation_, settings_, size_px);
            glFinish();
            if (first_frame_ms_ == 0) first_frame_ms_ = watch.ms();
            timers_.end_frame();
        }
        timers_.finish();
    }

    const Simulation& simulation_;
    Settings settings_;
    gl::Timers timers_;
    Renderer renderer_;
    glm::ivec2 size_px_{0};
    double first_frame_ms_ = 0;
};

void measure_scene(const BenchWorld& world, const BenchOptions& options, BenchResult& result) {
    std::unique_ptr<EmbreeScene> embree;
    if (!embree_version().empty()) embree = std::make_unique<EmbreeScene>(world.scene.cells, options.threads);
    std::vector<std::unique_ptr<FrameCase>> cases;
    const auto names = choice_names<Quality>();
    for (std::size_t i = 0; i < names.size(); ++i)
        cases.push_back(std::make_unique<FrameCase>(world, static_cast<Quality>(i)));

    for (const glm::ivec2 size_px : options.frame_sizes_px) {
        std::vector<Contestant> contestants;
        for (std::size_t i = 0; i < names.size(); ++i)
            contestants.push_back({.suite = "frame",
                                   .scene = world.scene.name,
                                   .who = names[i],
                                   .run = [c = cases[i].get(), size_px] { return c->run(size_px); }});
        const EmbreeRays rays(make_primary_rays(world.scene.settings, size_px));
        std::vector<float> distance;
        if (embree)
            contestants.push_back(
                {.suite = "frame", .scene = world.scene.name, .who = "embree-8", .run = [&] {
                     return std::vector<Sample>{{fmt::format("primary rays {}x{}", size_px.x, size_px.y),
                                                 "ms", mean_ms_of_runs(rays_least_ms, [&] {
                                                     return embree->trace(rays, true, distance);
                                                 })}};
                 }});
        run_rounds(contestants, {.rounds = options.rounds, .budget_ms = 1500}, result.figures,
                   options.progress);
    }
    for (std::size_t i = 0; i < names.size(); ++i)
        add_sample(result.figures, {"frame", world.scene.name, "first frame, compiling", names[i]}, "ms",
                   cases[i]->first_frame_ms());
}

}  // namespace

void run_frame_suite(const BenchOptions& options, BenchResult& result) {
    if (embree_version().empty())
        result.notes.emplace_back(
            "frame: Embree is left out: this program was built without it (install libembree-dev, configure "
            "anew)");
    options.progress("frame: building lake");
    measure_scene(*make_builtin_world("lake"), options, result);
    for (const int side : options.sides_vox) {
        options.progress(fmt::format("frame: building {}", bench_scene_name(side)));
        measure_scene(*make_bench_world(side), options, result);
    }
}

}  // namespace tarn
