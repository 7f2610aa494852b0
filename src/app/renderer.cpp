#include "app/renderer.h"

#include <algorithm>
#include <cmath>

#include "app/camera.h"
#include "app/error_estimate.h"
#include "app/frame_block.h"
#include "app/renderer_parts.h"
#include "app/trace_needs.h"
#include "core/error.h"
#include "gl/framebuffer.h"
#include "passes/bricks.h"
#include "shared/bindings.h"
#include "shared/trace.h"

namespace tarn {

namespace {

// Water counts as moving for so many frames after a change.
constexpr std::size_t moving_frames = 8;

// Of versions of the world, which wrap.
bool is_later(std::uint32_t a, std::uint32_t b) {
    return a != b && a - b <= INT32_MAX;
}

}  // namespace

TraceShapes Renderer::Parts::shapes(const Simulation& simulation) const {
    const FrameTargets& frame = targets->frames[0];
    return {.cells = simulation.cells().small_like(),
            .brick_rooms = simulation.brick_rooms().small_like(),
            .brick_changed = simulation.brick_changed().small_like(),
            .albedo_table = albedo.dielectric.small_like(),
            .metal_albedo_table = albedo.metal.small_like(),
            .glass_albedo_table = albedo.glass.small_like(),
            .targets = {targets->radiance[0].small_like(), frame.surface.small_like()}};
}

Renderer::Parts::Needs Renderer::Parts::needs_of(const Simulation& simulation, const Settings& of,
                                                 const FrameBlock& in) const {
    const auto held = [&](std::size_t id) { return contents.may_hold(simulation, id); };
    const TraceFeatures needed = with(always, needed_features(of, materials, in, held));
    return {needed, with(needed, general_features(of, materials))};
}

TracePrograms::Choice Renderer::Parts::program_for(const Simulation& simulation, const Settings& of,
                                                   const FrameBlock& in) {
    const Needs needs = needs_of(simulation, of, in);
    return trace.choose(needs.needed, needs.general, shapes(simulation));
}

const TracePass& Renderer::Parts::choose_program(const Simulation& simulation) {
    const TracePrograms::Choice choice = program_for(simulation, settings, block);
    // A setting takes effect with its program: history begins anew after this frame.
    effect_is_late = choice.exact && !exact_program;
    exact_program = choice.exact;
    return choice.pass;
}

void Renderer::Parts::prepare_targets(const Settings& now, glm::ivec2 size_px) {
    const glm::ivec2 traced =
        glm::max(glm::ivec2(1), glm::ivec2(glm::round(glm::vec2(size_px) * now.resolution_scale)));
    const bool exact = now.history == History::Exact;
    const bool averaged = now.history == History::Count || now.history == History::Blend;
    const bool upsampled = averaged && now.guided_upsampling && traced != size_px;
    if (targets && targets->traced_px == traced && targets->shown_px == size_px && targets->exact == exact &&
        targets->upsampled == upsampled)
        return;
    views.drop_targets();  // before the new ones take memory
    targets.reset();
    targets.emplace(traced, size_px, exact, upsampled);
    has_history = false;
}

void Renderer::Parts::upload_frame(const Simulation& simulation, const Settings& now) {
    const bool exact = now.history == History::Exact;
    if (difference(now, settings) >= SettingEffect::IMAGE) has_history = false;
    // Exact mode keeps no frame of another view or another world.
    if (exact) {
        const std::uint32_t change = simulation.last_change();
        if (!same_eye(now, settings) || change != world_change) has_history = false;
        world_change = change;
    }
    // A lamp that was built or taken lights all at once; histories behind water would keep its image.
    const std::uint64_t lamps = contents.emissive_edits(simulation, materials);
    if (lamps != lamps_edited) has_history = false;
    lamps_edited = lamps;
    if (!has_history) frames_kept = 0;
    settings = now;

    apply_water_settings(now, materials);
    const auto entries = make_material_block(materials);
    material_block.upload(entries);
    block_before = block;
    block = make_frame_block({.settings = now,
                              .world_size_vox = simulation.size_vox(),
                              .metres_per_voxel = metres_per_voxel,
                              .seed = seed,
                              .frame_index = static_cast<std::uint32_t>(frame_index),
                              .frames_kept = static_cast<std::uint32_t>(frames_kept),
                              .traced_px = targets->traced_px,
                              .shown_px = targets->shown_px,
                              .scattered = targets->upsampled});
    if (has_history) set_previous_eye(block, block_before);
    block.world_size_vox.w = has_history ? 1 : 0;
    frame_block.upload(std::span(&block, 1));
    frame_block.bind_uniform(BINDING_FRAME);
    material_block.bind_uniform(BINDING_MATERIALS);
}

void Renderer::Parts::update_emitters(const Simulation& simulation) {
    built(emitters, bricks_of(simulation.size_vox()))
        .record({.cells = simulation.cells(),
                 .changes = simulation.changes(),
                 .version = static_cast<std::uint32_t>(simulation.version())},
                timers);
}

TracePass::Inputs Renderer::Parts::trace_inputs(const Simulation& simulation, const TraceFeatures& features) {
    return {.cells = simulation.cells(),
            .brick_rooms = simulation.brick_rooms(),
            .albedo_table = albedo.dielectric,
            .metal_albedo_table = albedo.metal,
            .glass_albedo_table = albedo.glass,
            .emitters = features.emitters ? &*emitters : nullptr,
            .rejected = rejected,
            .brick_changed = simulation.brick_changed(),
            .still_since = versions.front()};
}

bool Renderer::Parts::world_changed(const Simulation& simulation) const {
    return simulation.version() != world_version &&
           is_later(simulation.last_change(), static_cast<std::uint32_t>(world_version));
}

// False where next to no pixel can have the mark of moving water (glsl/lib/surface.glsl). May wait for the
// GPU.
bool Renderer::Parts::water_may_move(const Simulation& simulation) const {
    return contents.may_hold(simulation, MATERIAL_WATER) &&
           static_cast<std::uint32_t>(simulation.version()) != versions.front() &&
           is_later(simulation.last_change(), versions.front());
}

// Some of the last frame's paths, with its eye and its random numbers, in the world as it is now. Null where
// the world has not changed or nothing asks for it.
const Retraced* Renderer::Parts::retrace(const Simulation& simulation, const TracePass& pass) {
    if (settings.history != History::Count || !settings.retrace_changes || !has_history) return nullptr;
    const bool edited = simulation.last_edit() > world_version;
    if (!edited && !world_changed(simulation)) return nullptr;
    const Retraced& retraced = targets->retraced_after(edited);
    frame_block.upload(std::span(&block_before, 1));
    TracePass::Inputs inputs = trace_inputs(simulation, pass.features());
    inputs.stride = static_cast<std::uint32_t>(retraced.stride);
    // What this frame will write over is still the frame before the last, whose new pixels took more paths.
    ask_for_new_pixels(inputs, current);
    pass.record(inputs, {.target = retraced.target}, timers);
    frame_block.upload(std::span(&block, 1));
    return &retraced;
}

std::uint32_t Renderer::Parts::new_pixel_samples() const {
    return settings.history == History::Count ? static_cast<std::uint32_t>(settings.new_pixel_samples) : 1;
}

void Renderer::Parts::ask_for_new_pixels(TracePass::Inputs& inputs, int previous) const {
    inputs.new_pixel_samples = new_pixel_samples();
    inputs.previous_radiance = &targets->frames[previous].history;
    inputs.previous_surface = &targets->frames[previous].surface;
}

const gl::Texture& Renderer::Parts::accumulate_exact() {
    const Sums& previous = targets->sums[1 - current];
    built(accumulate)
        .record({.radiance = targets->radiance[current],
                 .previous_sum = previous.sum,
                 .previous_correction = previous.correction,
                 .previous_mean = targets->filtered[1 - current],
                 .rejected = rejected},
                {.sums = targets->sums_target[current]}, timers);
    return targets->filtered[current];
}

const gl::Texture& Renderer::Parts::reproject_and_filter(const Simulation& simulation,
                                                         const Retraced* retraced, bool water_moves) {
    const gl::Texture* radiance = &targets->radiance[current];
    if (settings.history != History::None) {
        const bool blend = settings.history == History::Blend;
        const bool moments = views.keeps_moments();
        const bool upsample = targets->upsampled;
        built(temporal[blend][moments][upsample], blend, moments, upsample)
            .record({.current = {targets->radiance[current], targets->traced_surface_of(current)},
                     .previous = surfaces(1 - current, targets->frames[1 - current].history),
                     .cells = simulation.cells(),
                     .brick_changed = simulation.brick_changed(),
                     .new_pixel_samples = new_pixel_samples(),
                     .previous_version = static_cast<std::uint32_t>(world_version),
                     .rejected = rejected,
                     .traced_before = retraced != nullptr ? &targets->radiance[1 - current] : nullptr,
                     .retraced = retraced != nullptr ? &retraced->paths : nullptr,
                     .retrace_stride = retraced != nullptr ? retraced->stride : 0,
                     .previous_moments = views.previous_moments(current)},
                    {.history = views.history_target(*targets, current)}, timers);
        radiance = &targets->frames[current].history;
    }
    if (settings.filter == Filter::None) return *radiance;
    const bool gaussian = settings.filter == Filter::Gaussian;
    const FilterPass::Kind kind = gaussian      ? FilterPass::Kind::Gaussian
                                  : water_moves ? FilterPass::Kind::Moving
                                                : FilterPass::Kind::Still;
    // Before it is needed, where there is water: the first tick that moves it is not to wait for it.
    if (!gaussian && contents.may_hold(simulation, MATERIAL_WATER))
        built(filter[static_cast<int>(FilterPass::Kind::Moving)], FilterPass::Kind::Moving);
    const int axes = gaussian ? 2 : 1;
    for (int i = 0; i < axes * settings.filter_passes; ++i) {
        const int distance = 1 << (i / axes);
        const glm::ivec2 step(gaussian && i % 2 == 1 ? 0 : distance, gaussian && i % 2 == 0 ? 0 : distance);
        built(filter[static_cast<int>(kind)], kind)
            .record({.surfaces = surfaces(current, *radiance), .step_px = step},
                    {.target = targets->filter_target[i % 2]}, timers);
        radiance = &targets->filtered[i % 2];
    }
    return *radiance;
}

void Renderer::Parts::show_picture(const gl::Framebuffer& target, bool raw) {
    const Refinement& r = refinement;
    DisplayPass::Inputs inputs{.radiance = *shown};
    const bool refined = r.samples > 0;
    if (refined) {
        inputs.exact_mean = &r.targets->filtered[r.current];
        inputs.exact_sum = &r.targets->sums[r.current].sum;
        inputs.exact_samples = r.samples;
    }
    built(display[raw][refined], raw, refined).record(inputs, {.picture = target}, timers);
}

void Renderer::Parts::render_preset(const Simulation& simulation, const Settings& now, glm::ivec2 size_px) {
    prepare_targets(now, size_px);
    upload_frame(simulation, now);
    current = 1 - current;
    const TracePass& pass = choose_program(simulation);
    if (pass.features().emitters) update_emitters(simulation);
    views.prepare(settings, *targets, has_history);
    const Retraced* retraced = retrace(simulation, pass);
    // Asked before the trace is recorded, or the answer would wait for it.
    const bool water_moves = settings.filter == Filter::EdgeAware && water_may_move(simulation);
    TracePass::Inputs inputs = trace_inputs(simulation, pass.features());
    ask_for_new_pixels(inputs, 1 - current);
    pass.record(inputs, {.target = views.trace_target(*targets, current)}, timers);
    shown = settings.history == History::Exact ? &accumulate_exact()
                                               : &reproject_and_filter(simulation, retraced, water_moves);
    shown = &smooth_edges(simulation, *shown);
    has_history = !effect_is_late;
    frames_kept = std::min<std::uint64_t>(frames_kept + 1, FRAMES_KEPT_MAX);
}

// The last frame: its radiance, or the view of it that is asked for.
void Renderer::Parts::show(const gl::Framebuffer& target, bool raw) {
    if (settings.view == ViewKind::Picture)
        show_picture(target, raw);
    else
        views.show(*targets, current, raw, target, timers);
}

Renderer::Renderer(const Scene& scene, gl::Timers& timers, TracePrograms* programs)
    : parts_(std::make_unique<Parts>(scene, timers, programs)) {}

Renderer::~Renderer() = default;

const gl::Texture& Renderer::render(const Simulation& simulation, const Settings& settings,
                                    glm::ivec2 size_px) {
    Parts& p = *parts_;
    p.versions.resize(moving_frames, static_cast<std::uint32_t>(simulation.version()));
    if (p.is_at_rest(simulation, settings, size_px))
        p.refine(simulation, settings);
    else
        p.render_preset(simulation, settings, size_px);
    p.show(p.targets->picture_target, false);

    p.world_version = simulation.version();
    p.versions.pop_front();
    p.versions.push_back(static_cast<std::uint32_t>(p.world_version));
    ++p.frame_index;
    return p.targets->picture;
}

void Renderer::world_replaced() {
    parts_->emitters.reset();
    parts_->versions.clear();
    reset_history();
}

void Renderer::compile_in(const TraceFeatures& always) {
    parts_->always = always;
}

void Renderer::reset_history() {
    parts_->has_history = false;
    parts_->error.forget();
}

void Renderer::set_frame_index(std::uint64_t index) {
    parts_->frame_index = index;
}

ImageRgba8 Renderer::read_picture() const {
    CHECK(parts_->targets);
    const glm::ivec2 size = parts_->targets->shown_px;
    std::vector<std::uint8_t> pixels(std::size_t{4} * size.x * size.y);
    parts_->targets->picture.download(std::span(pixels), GL_RGBA, GL_UNSIGNED_BYTE);
    ImageRgba8 image{size.x, size.y, {}};
    const std::size_t row = std::size_t{4} * size.x;
    image.pixels.reserve(pixels.size());
    for (int y = size.y - 1; y >= 0; --y)
        image.pixels.insert(image.pixels.end(), pixels.begin() + y * row, pixels.begin() + (y + 1) * row);
    return image;
}

ImageRgb32f Renderer::read_radiance() const {
    Parts& p = *parts_;
    CHECK(p.targets && p.shown != nullptr);
    const glm::ivec2 size = p.targets->shown_px;
    const gl::Texture resolved({.label = "shown radiance", .format = GL_RGBA32F, .size = {size, 0}});
    const gl::Framebuffer target("shown radiance", {&resolved});
    p.frame_block.upload(std::span(&p.block, 1));
    p.frame_block.bind_uniform(BINDING_FRAME);
    p.material_block.bind_uniform(BINDING_MATERIALS);
    p.show(target, true);
    std::vector<float> pixels(std::size_t{3} * size.x * size.y);
    resolved.download(std::span(pixels), GL_RGB, GL_FLOAT);
    ImageRgb32f image{size.x, size.y, {}};
    const std::size_t row = std::size_t{3} * size.x;
    image.pixels.reserve(pixels.size());
    for (int y = size.y - 1; y >= 0; --y)
        image.pixels.insert(image.pixels.end(), pixels.begin() + y * row, pixels.begin() + (y + 1) * row);
    return image;
}

std::uint64_t Renderer::samples() const {
    if (parts_->refinement.samples > 0) return parts_->refinement.samples;
    const Settings& s = parts_->settings;
    std::uint64_t frames = 1;
    if (s.history == History::Exact) frames = parts_->frames_kept;
    if (s.history == History::Count) frames = std::min<std::uint64_t>(parts_->frames_kept, s.history_cap);
    return frames * static_cast<std::uint64_t>(s.samples_per_pixel);
}

bool Renderer::is_refining() const {
    return parts_->refinement.targets.has_value();
}

std::uint64_t Renderer::rejected_samples() const {
    std::uint32_t count = 0;
    parts_->rejected.download(std::span(&count, 1));
    return count;
}

double Renderer::compile_ms() const {
    return parts_->compile_ms + parts_->views.compile_ms() + parts_->trace.waited_ms();
}

std::vector<std::string> Renderer::poll_reload() {
    std::vector<std::string> messages;
    const auto poll_program = [&](gl::Program& program) {
        if (auto message = program.poll_reload()) {
            messages.push_back(*message);
        }
    };
    const auto poll = [&](auto& pass) {
        if (pass) poll_program(pass->program());
    };
    parts_->trace.poll_reload(messages);
    parts_->views.for_each_program(poll_program);
    parts_->error.for_each_program(poll_program);
    for (int i = 0; i < 2; ++i) {
        for (auto& pair : parts_->temporal[i])
            for (auto& pass : pair) poll(pass);
        for (auto& pass : parts_->display[i]) poll(pass);
        poll(parts_->pick[i]);
    }
    for (auto& pass : parts_->filter) poll(pass);
    poll(parts_->accumulate);
    poll(parts_->antialias);
    if (parts_->emitters) parts_->emitters->poll_reload(messages);
    if (!messages.empty()) parts_->has_history = false;
    return messages;
}

}  // namespace tarn
