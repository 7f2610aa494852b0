// What code without need costs: pictures of scenes that have no need of a feature, with its code compiled in
// and left out, in turn; and what a world at rest costs per frame. Pictures must agree to the bit.
#include <fmt/format.h>

#include <memory>

#include "app/renderer.h"
#include "app/stopwatch.h"
#include "bench/bench_suites.h"
#include "passes/trace_pass.h"

namespace tarn {

namespace {

constexpr glm::ivec2 frame_size_px{320, 180};
constexpr double least_ms = 60;  // a sample's: shorter ones slip between the turns of other programs

// A program that can do more than the scene needs.
struct Variant {
    const char* name;
    const char* without;  // the one that it is compared with
    TraceFeatures more;
};
const Variant needed{"needed", nullptr, {}};
const Variant clear{"clear", "needed", {.clear = true}};
const Variant rough_of_clear{"rough", "clear", {.clear = true, .rough = true}};
const Variant smooth_water{"smooth-water", "clear", {.clear = true, .smooth_water = true}};
const Variant rough{"rough", "needed", {.rough = true}};
const Variant coated{"coated", "needed", {.coated = true}};
const Variant emitters{"emitters", "needed", {.emitters = true}};
const Variant sun{"sun", "needed", {.sun = true}};
const Variant all{
    "all",
    "needed",
    {.clear = true, .rough = true, .coated = true, .sun = true, .emitters = true, .smooth_water = true}};

enum class Ticks { None, AtRest, Awake };

class VariantCase {
  public:
    VariantCase(BenchWorld& world, const TraceFeatures& more, Ticks ticks)
        : world_(world), ticks_(ticks), renderer_(world.scene, timers_) {
        renderer_.compile_in(more);
    }
    double frame_ms() {
        return mean_ms_of_runs(least_ms, [&] {
            if (ticks_ != Ticks::None) world_.simulation.set_always_awake(ticks_ == Ticks::Awake);
            if (ticks_ == Ticks::AtRest) world_.simulation.put_to_sleep();
            glFinish();
            const Stopwatch watch;
            if (ticks_ != Ticks::None) world_.simulation.step(1, world_.scene.settings);
            renderer_.render(world_.simulation, world_.scene.settings, frame_size_px);
            glFinish();
            const double ms = watch.ms();
            for (gl::Timers* timers : {&timers_, &world_.timers}) {
                timers->end_frame();
                timers->finish();
            }
            return ms;
        });
    }
    std::vector<float> picture() {
        renderer_.set_frame_index(1);
        renderer_.reset_history();
        renderer_.render(world_.simulation, world_.scene.settings, frame_size_px);
        return renderer_.read_radiance().pixels;
    }

  private:
    BenchWorld& world_;
    Ticks ticks_;
    gl::Timers timers_;
    Renderer renderer_;
};

void measure(const std::string& scene, BenchWorld& world, const std::vector<Variant>& variants,
             bool with_ticks, const BenchOptions& options, BenchResult& result) {
    // Of what sleeps nothing changes a picture, nor the next one's history.
    world.simulation.put_to_sleep();
    struct Pair {
        std::string name, without;
    };
    std::vector<Pair> pairs;
    std::vector<std::unique_ptr<VariantCase>> cases;
    for (const Variant& v : variants) {
        cases.push_back(std::make_unique<VariantCase>(world, v.more, Ticks::None));
        pairs.push_back({v.name, v.without == nullptr ? "" : v.without});
    }
    const std::vector<float> expected = cases.front()->picture();
    for (std::size_t i = 1; i < cases.size(); ++i)
        if (cases[i]->picture() != expected)
            result.failures.push_back(
                fmt::format("variants {} {}: another picture than without", scene, pairs[i].name));
    if (with_ticks) {
        cases.push_back(std::make_unique<VariantCase>(world, TraceFeatures{}, Ticks::AtRest));
        pairs.push_back({"tick at rest", "needed"});
        cases.push_back(std::make_unique<VariantCase>(world, TraceFeatures{}, Ticks::Awake));
        pairs.push_back({"tick awake", "tick at rest"});
    }
    const std::string what = fmt::format("frame {}x{}", frame_size_px.x, frame_size_px.y);
    std::vector<Contestant> contestants;
    for (std::size_t i = 0; i < cases.size(); ++i)
        contestants.push_back(
            {.suite = "variants", .scene = scene, .who = pairs[i].name, .run = [&what, c = cases[i].get()] {
                 return std::vector<Sample>{{what, "ms", c->frame_ms()}};
             }});
    // All take part in all rounds: only so has each round its ratios.
    run_rounds(contestants, {.rounds = options.rounds, .budget_ms = 1e9}, result.figures, options.progress);
    world.simulation.set_always_awake(false);
    for (const Pair& pair : pairs) {
        const BenchFigure* with = find_figure(result.figures, {"variants", scene, what, pair.name});
        const BenchFigure* without = find_figure(result.figures, {"variants", scene, what, pair.without});
        if (with == nullptr || without == nullptr) continue;
        const std::vector<double> in = with->samples, out = without->samples;
        for (std::size_t i = 0; i < in.size(); ++i)
            add_sample(result.figures, {"variants", scene, "with / without", pair.name}, "ratio",
                       in[i] / out[i]);
    }
}

}  // namespace

void run_variants_suite(const BenchOptions& options, BenchResult& result) {
    const int side = options.sides_vox.front();
    options.progress("variants: building worlds");
    {
        const auto world = make_dry_bench_world(side);
        measure(world->scene.name, *world,
                {needed, clear, rough_of_clear, smooth_water, coated, emitters, all}, false, options, result);
    }
    {
        const auto world = make_bench_world(side);
        measure(world->scene.name, *world, {needed, rough, coated, emitters, all}, true, options, result);
    }
    const auto world = make_builtin_world("cave");
    measure(world->scene.name, *world, {needed, sun, all}, false, options, result);
}

}  // namespace tarn
