// What the renderer is made of, for its own source files: renderer.cpp (the pass order), refinement.cpp (at
// rest), picture_trial.cpp (its error).
#pragma once
#include <deque>
#include <optional>

#include "app/albedo_textures.h"
#include "app/error_estimate.h"
#include "app/frame_block.h"
#include "app/render_targets.h"
#include "app/renderer.h"
#include "app/stopwatch.h"
#include "app/views.h"
#include "app/world_contents.h"
#include "gl/buffer.h"
#include "passes/accumulate_pass.h"
#include "passes/antialias_pass.h"
#include "passes/display_pass.h"
#include "passes/emitters.h"
#include "passes/filter_pass.h"
#include "passes/pick_pass.h"
#include "passes/temporal_pass.h"
#include "passes/trace_programs.h"
#include "shared/frame.h"

namespace tarn {

// The exact mean that a picture at rest glides into.
struct Refinement {
    std::uint32_t frames_at_rest = 0;      // eye, settings and world as they were
    std::optional<RenderTargets> targets;  // exact, of the shown size; while refining
    Settings settings;                     // exact
    FrameBlock block;
    int current = 0;            // of the targets' sets
    int band = 0;               // of the picture, that the next frame traces
    std::uint32_t samples = 0;  // in the mean, per pixel
};

// How the shown picture is tried by samples of exact mode.
struct PictureTrial {
    Settings settings;  // exact
    FrameBlock block;
    std::uint32_t index = 0;  // of the next sample
    Settings of;              // of the picture tried last
    bool refined = false;     // that was
    EditTotals edits;         // of its world
};

struct Renderer::Parts {
    gl::Timers& timers;
    WorldContents contents;
    MaterialTable materials;
    float metres_per_voxel;
    std::uint32_t seed;

    AlbedoTextures albedo = make_albedo_textures();
    gl::Buffer frame_block{"frame block", sizeof(FrameBlock)};
    gl::Buffer material_block{"materials", sizeof(make_material_block({}))};
    gl::Buffer rejected{"rejected samples", sizeof(std::uint32_t)};

    // A program is built when first used: a run pays for the passes it needs.
    double compile_ms = 0;
    TracePrograms own_trace;  // of a renderer that is given none
    TracePrograms& trace;
    TraceFeatures always{};     // compiled in whatever the scene needs
    bool exact_program = true;  // TracePrograms::Choice::exact of the last frame
    bool effect_is_late = false;
    std::optional<EmittersPass> emitters;
    std::optional<TemporalPass> temporal[2][2][2];  // [blend][moments][upsample]
    std::optional<FilterPass> filter[3];            // [FilterPass::Kind]
    std::optional<AccumulatePass> accumulate;
    std::optional<AntialiasPass> antialias;
    std::optional<DisplayPass> display[2][2];  // [radiance only][refined]
    std::optional<PickPass> pick[2];           // [through water]

    std::optional<RenderTargets> targets;
    Views views;
    ErrorEstimate error;
    FrameBlock block;  // of the last frame
    FrameBlock block_before;
    Settings settings;  // of the last frame
    int current = 0;    // which of the two sets the last frame wrote
    bool has_history = false;
    std::uint32_t world_change = 0;      // Simulation::last_change() seen by the last frame of exact mode
    std::uint64_t world_version = 0;     // seen by the last frame
    std::deque<std::uint32_t> versions;  // likewise, low bits, of the last moving_frames frames; oldest first
    std::uint64_t lamps_edited = 0;      // emissive_edits() seen by the last frame
    std::uint64_t frame_index = 0;
    std::uint64_t frames_kept = 0;
    const gl::Texture* shown = nullptr;  // radiance of the last frame that the preset made
    Refinement refinement;
    PictureTrial trial;

    Parts(const Scene& scene, gl::Timers& timers_, TracePrograms* programs)
        : timers(timers_),
          contents(scene),
          materials(scene.materials),
          metres_per_voxel(scene.metres_per_voxel),
          seed(scene.seed),
          trace(programs != nullptr ? *programs : own_trace) {}

    template <typename Pass, typename... Arguments>
    Pass& built(std::optional<Pass>& pass, Arguments... arguments) {
        if (!pass) {
            const Stopwatch watch;
            pass.emplace(arguments...);
            compile_ms += watch.ms();
        }
        return *pass;
    }
    TraceShapes shapes(const Simulation& simulation) const;
    struct Needs {
        TraceFeatures needed, general;  // as TracePrograms::choose() takes them
    };
    Needs needs_of(const Simulation& simulation, const Settings& of, const FrameBlock& in) const;
    // Of the shown picture.
    TracePrograms::Choice program_for(const Simulation& simulation, const Settings& of, const FrameBlock& in);
    const TracePass& choose_program(const Simulation& simulation);
    void prepare_targets(const Settings& now, glm::ivec2 size_px);
    void upload_frame(const Simulation& simulation, const Settings& now);
    SurfaceBuffers surfaces(int set, const gl::Texture& radiance) const {
        const FrameTargets& frame = targets->frames[set];
        return {radiance, frame.surface};
    }
    void update_emitters(const Simulation& simulation);
    TracePass::Inputs trace_inputs(const Simulation& simulation, const TraceFeatures& features);
    // Since the last frame. May wait for the GPU.
    bool world_changed(const Simulation& simulation) const;
    const Retraced* retrace(const Simulation& simulation, const TracePass& pass);
    std::uint32_t new_pixel_samples() const;
    // Of the picture that comes after the one in the set `previous`.
    void ask_for_new_pixels(TracePass::Inputs& inputs, int previous) const;
    const gl::Texture& accumulate_exact();
    bool water_may_move(const Simulation& simulation) const;
    const gl::Texture& reproject_and_filter(const Simulation& simulation, const Retraced* retraced,
                                            bool water_moves);
    // Edges smoothed, where it is asked for: `radiance` is of the pixels whose surfaces the last frame keeps.
    const gl::Texture& smooth_edges(const Simulation& simulation, const gl::Texture& radiance);
    void render_preset(const Simulation& simulation, const Settings& now, glm::ivec2 size_px);
    void show_picture(const gl::Framebuffer& target, bool raw);
    void show(const gl::Framebuffer& target, bool raw);

    // Whether this frame may add to the exact mean in place of the preset's; counts frames at rest.
    bool is_at_rest(const Simulation& simulation, const Settings& now, glm::ivec2 size_px);
    void refine(const Simulation& simulation, const Settings& now);

    const TracePass* trial_program(const Simulation& simulation);
    void draw_trial_sample(const Simulation& simulation, const TracePass& pass, const gl::Framebuffer& target,
                           int stride);
};

bool same_eye(const Settings& a, const Settings& b);

}  // namespace tarn
