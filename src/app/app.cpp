#include "app/app.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/legend.h"
#include "app/overlay.h"
#include "app/undo.h"
#include "core/error.h"
#include "core/front.h"

namespace tarn {

namespace {

constexpr double poll_interval_s = 0.5;
constexpr double error_interval_s = 0.5;
constexpr std::uint64_t error_interval_frames = 16;  // of slow ones: it costs part of a frame
constexpr double message_s = 5;
constexpr double rate_window_s = 0.5;

Actions actions_of(const Input& input) {
    Actions actions;
    actions.toggle_pause = input.was_pressed(Key::Pause);
    actions.step = input.was_pressed(Key::Step);
    actions.faster = input.was_pressed(Key::Faster);
    actions.slower = input.was_pressed(Key::Slower);
    actions.reload = input.was_pressed(Key::Reset);
    actions.undo = input.was_pressed(Key::Undo);
    actions.redo = input.was_pressed(Key::Redo);
    actions.screenshot = input.was_pressed(Key::Screenshot);
    actions.record = input.was_pressed(Key::Record);
    actions.home = input.was_pressed(Key::Home);
    return actions;
}

// Another scene brings its camera, water, sun and sky; how the player sees and runs it stays.
Settings carried_over(const Settings& from_scene, const Settings& current) {
    Settings settings = from_scene;
    for (const SettingInfo& info : setting_infos()) {
        const bool of_scene = info.group == SettingGroup::CAMERA || info.group == SettingGroup::WATER ||
                              info.group == SettingGroup::SKY;
        if (!of_scene) info.set(settings, info.get(current));
    }
    return settings;
}

bool same_camera(const Settings& a, const Settings& b) {
    return a.camera_position_vox == b.camera_position_vox && a.camera_yaw_deg == b.camera_yaw_deg &&
           a.camera_pitch_deg == b.camera_pitch_deg && a.camera_fov_deg == b.camera_fov_deg;
}

ViewKind neighbour_of(ViewKind view, bool backwards) {
    const auto count = static_cast<int>(choice_names<ViewKind>().size());
    return static_cast<ViewKind>((static_cast<int>(view) + (backwards ? count - 1 : 1)) % count);
}

std::vector<double> front_times() {
    std::vector<double> times;
    for (const FrontPoint& point : front()) times.push_back(point.time);
    return times;
}

// Of the last frame that is known, the passes whose work the settings of the trade decide.
double picture_ms(const gl::Timers& timers) {
    double sum_ms = 0;
    for (const gl::PassTime& pass : timers.passes()) {
        if (pass.last_frame != timers.last_frame()) continue;
        for (const char* name :
             {"trace", "temporal", "accumulate", "filter", "antialias", "display", "emitters"})
            if (pass.name == name) sum_ms += pass.last_ms;
    }
    return sum_ms;
}

double tick_ms_total(const gl::Timers& timers) {
    double sum_ms = 0;
    for (const gl::PassTime& pass : timers.passes()) {
        if (pass.name == "step" || pass.name == "flow" || pass.name == "head") sum_ms += pass.total_ms;
    }
    return sum_ms;
}

}  // namespace

App::App(Scene scene, const Settings& settings, Options options)
    : options_(options),
      scene_(std::move(scene)),
      settings_(settings),
      rendered_(settings),
      trace_programs_(options.interactive && options.platform != nullptr
                          ? options.platform->make_shared_context()
                          : nullptr),
      simulation_(std::make_unique<Simulation>(scene_, timers_)),
      renderer_(std::make_unique<Renderer>(scene_, timers_, &trace_programs_)),
      governor_(front_times()) {
    set_title();
}

App::~App() = default;

double App::now_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void App::set_title() {
    if (options_.platform != nullptr) options_.platform->set_title("Tarn - " + scene_.name);
}

void App::say(const std::string& text) {
    message_ = text;
    message_until_s_ = now_s() + message_s;
}

void App::load(const std::string& name_or_path) {
    Settings base;
    apply_quality(base, Quality::Balanced);
    Scene scene = load_scene(name_or_path, base);
    end_recording();
    auto simulation = std::make_unique<Simulation>(scene, timers_);
    auto renderer = std::make_unique<Renderer>(scene, timers_, &trace_programs_);
    scene_ = std::move(scene);
    simulation_ = std::move(simulation);
    renderer_ = std::move(renderer);
    settings_ = carried_over(scene_.settings, settings_);
    history_.clear();
    tools_.end_stroke();
    set_title();
}

void App::reload() {
    end_recording();
    simulation_ = std::make_unique<Simulation>(scene_, timers_);
    renderer_->world_replaced();
    history_.clear();
    tools_.end_stroke();
}

const gl::Texture& App::frame(const Input& input) {
    const bool interactive = options_.interactive && input.interactive;
    Actions actions;
    if (interactive) {
        if (now_s() >= next_poll_s_) {
            poll_shaders();
            watch_eye();
        }
        change_settings(input, actions);
        run_actions(actions);
    }
    if (difference(settings_, rendered_) != SettingEffect::NONE) renderer_->reset_history();
    if (options_.platform != nullptr) options_.platform->set_vsync(settings_.vsync);
    if (interactive) edit(input);
    advance(input);

    renderer_->keep_variance(interactive && settings_.overlay);
    const gl::Texture& picture = renderer_->render(*simulation_, settings_, input.size_px);
    rendered_ = settings_;
    ++frames_;
    if (actions.screenshot) write_screenshot();
    if (interactive && settings_.overlay && now_s() >= next_error_s_ && frames_ >= next_error_frame_) {
        renderer_->measure_error(*simulation_);
        next_error_s_ = now_s() + error_interval_s;
        next_error_frame_ = frames_ + error_interval_frames;
    }
    timers_.end_frame();
    if (interactive) simulation_->refresh_census(now_s());
    if (interactive) draw_overlays(input);
    return picture;
}

void App::poll_shaders() {
    next_poll_s_ = now_s() + poll_interval_s;
    rejected_samples_ = renderer_->rejected_samples();
    std::vector<std::string> messages = simulation_->poll_reload();
    for (std::string& message : renderer_->poll_reload()) messages.push_back(std::move(message));
    if (messages.empty()) return;
    shader_error_.clear();
    for (const std::string& message : messages) {
        if (!message.empty()) shader_error_ += message + "\n";
    }
    if (shader_error_.empty())
        say("shaders rebuilt");
    else
        fmt::print(stderr, "{}", shader_error_);
    renderer_->reset_history();
}

void App::set_captured(bool captured) {
    captured_ = captured;
    if (options_.platform != nullptr) options_.platform->capture_mouse(captured);
}

void App::change_settings(const Input& input, Actions& actions) {
    actions = actions_of(input);
    if (input.was_pressed(Key::MouseLook)) look_toggled_ = !look_toggled_;
    if (input.was_pressed(Key::Help)) panels_.help_open = !panels_.help_open;
    if (input.was_pressed(Key::Settings)) panels_.settings_open = !panels_.settings_open;
    // A panel that opens is there to be clicked.
    if ((input.was_pressed(Key::Help) && panels_.help_open) ||
        (input.was_pressed(Key::Settings) && panels_.settings_open))
        look_toggled_ = false;
    if (input.was_pressed(Key::Release)) {
        if (!look_toggled_) panels_.help_open = panels_.settings_open = false;
        look_toggled_ = false;
    }
    if (input.was_pressed(Key::View)) settings_.view = neighbour_of(settings_.view, input.is_down(Key::Fast));
    if (input.was_pressed(Key::Overlay)) settings_.overlay = !settings_.overlay;
    set_captured(look_toggled_ || input.is_down(Key::MouseLookHold));
    fly_in_world(input);
    tools_.choose(input);
    govern(input);

    if (panels_.settings_open && scenes_.empty()) scenes_ = builtin_scenes();
    const Settings before = settings_;
    panels_.draw({.settings = settings_,
                  .brush = tools_.brush,
                  .defaults = scene_.settings,
                  .scene = scene_.name,
                  .scenes = scenes_,
                  .paused = clock_.paused(),
                  .can_undo = history_.can_undo(),
                  .can_redo = history_.can_redo(),
                  .recording = recorder_.is_on(),
                  .expected_ms = governor_.expected_ms(front_point(settings_.tradeoff))},
                 actions);
    if (!same_camera(before, settings_)) renderer_->reset_history();  // a jump, not a flight
}

void App::govern(const Input& input) {
    // The time that ends now is of the frame before.
    frame_times_.add_frame(timers_.frame() - 1, input.dt_s * 1000);
    if (timers_.last_frame() >= 0) frame_times_.add_picture(timers_.last_frame(), picture_ms(timers_));
    // Of a refined picture's time the table knows nothing.
    if (renderer_->is_refining()) return;
    const std::size_t point = front_point(settings_.tradeoff);
    const double target_ms = settings_.governor ? settings_.frame_time_target_ms : 0;
    const std::size_t next = governor_.frame(input.dt_s * 1000, point, target_ms, frame_times_.fixed_ms());
    if (settings_.governor && next != point) apply_front_point(settings_, next);
}

// The ground stops the eye, unless it is in it already.
void App::fly_in_world(const Input& input) {
    const glm::vec3 from_vox = settings_.camera_position_vox;
    fly(settings_, input, captured_);
    if (settings_.fly_through_ground || settings_.camera_position_vox == from_vox) return;
    Settings probe = settings_;
    probe.max_distance_vox = static_cast<float>(find_setting("max_distance_vox")->max);
    settings_.camera_position_vox =
        slide(from_vox, settings_.camera_position_vox, [&](glm::vec3 at_vox, glm::vec3 dir) {
            probe.camera_position_vox = at_vox;
            const Pick found = renderer_->pick_along(*simulation_, probe, dir, true);
            return found.hit ? std::optional(found.cell) : std::nullopt;
        });
}

void App::watch_eye() {
    const glm::ivec3 cell(glm::floor(glm::clamp(settings_.camera_position_vox, -1.f, 2048.f)));
    const glm::ivec3 size = simulation_->size_vox();
    eye_hint_.clear();
    if (settings_.fly_through_ground) return;
    if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, size))) return;
    const std::uint8_t byte = simulation_->read_cell(cell);
    if (byte == MATERIAL_AIR || byte == MATERIAL_GLASS || is_water(byte)) return;
    eye_hint_ = fmt::format("The eye is inside {}: fly on, or press Home for the scene's own view.",
                            material_name(static_cast<std::uint8_t>(material_of(byte))));
}

void App::go_home() {
    for (const SettingInfo& info : setting_infos())
        if (std::string_view(info.name).starts_with("camera_"))
            info.set(settings_, info.get(scene_.settings));
    renderer_->reset_history();
    next_poll_s_ = 0;
}

void App::run_actions(const Actions& actions) {
    if (actions.home) go_home();
    if (actions.faster) clock_.faster();
    if (actions.slower) clock_.slower();
    if (actions.toggle_pause) clock_.toggle_paused();
    if (actions.step) clock_.single_step();
    try {
        if (actions.reload) reload();
        if (actions.load_scene) load(*actions.load_scene);
    } catch (const Error& error) {
        say(error.what());
    }
    if (actions.record) start_or_stop_recording();
    if (!actions.undo && !actions.redo) return;
    tools_.end_stroke();
    const bool done =
        actions.undo ? undo_stroke(*simulation_, history_) : redo_stroke(*simulation_, history_);
    if (done)
        frame_edits_.push_back({.kind = actions.undo ? RecordedEdit::Kind::Undo : RecordedEdit::Kind::Redo});
}

Pick App::pick(glm::ivec2 size_px, glm::vec2 at_px, bool through_water) {
    const Pick found = renderer_->pick(*simulation_, settings_, size_px, at_px, through_water);
    // An eye under water would meet nothing but the water around it.
    const bool within_water = found.hit && found.normal == glm::ivec3(0) && is_water(found.byte);
    return within_water ? renderer_->pick(*simulation_, settings_, size_px, at_px, true) : found;
}

void App::edit(const Input& input) {
    const glm::vec2 at_px = captured_ ? glm::vec2(input.size_px) / 2.f : input.mouse_px;
    const View view(settings_, input.size_px);
    if (input.was_pressed(MouseButton::Middle)) tools_.take_material(pick(input.size_px, at_px, false));
    Pick picked;
    if (tools_.needs_pick(input)) picked = pick(input.size_px, at_px, tools_.brush.goes_through_water());
    const Tools::Stroke stroke =
        tools_.use(input, picked, {view.eye_vox(), view.dir_through(at_px)}, simulation_->tick());
    if (stroke.begins) history_.begin_stroke();
    for (const Edit& e : stroke.edits) {
        simulation_->apply(e, history_);
        frame_edits_.push_back({.edit = e, .begins = stroke.begins && &e == &stroke.edits.front()});
    }
    if (tools_.aim()) {
        const Brush& brush = tools_.brush;
        draw_outline(view, brush, *tools_.aim(), tools_.removing(), outline_color(brush));
    }
    if (captured_) draw_cross();
}

glm::vec3 App::outline_color(const Brush& brush) const {
    if (brush.material == MATERIAL_WATER) return settings_.water_color;
    return scene_.materials[brush.material].base_color;
}

void App::advance(const Input& input) {
    int ticks = settings_.ticks_per_frame;
    if (options_.interactive) {
        const int by_clock = clock_.ticks_for(input.dt_s, settings_.ticks_per_second);
        if (ticks == 0 || clock_.paused()) ticks = by_clock;
    }
    simulation_->step(ticks, settings_);
    recorder_.add_frame(settings_, frame_edits_, ticks);
    frame_edits_.clear();
    rate_ticks_ += static_cast<std::uint64_t>(ticks);
    const double since_s = now_s() - rate_start_s_;
    if (since_s < rate_window_s) return;
    ticks_per_s_ = static_cast<double>(rate_ticks_) / since_s;
    // Timer results lag by some frames: near enough over half a second.
    const double total_ms = tick_ms_total(timers_);
    if (rate_ticks_ > 0)
        clock_.set_tick_cost_ms((total_ms - rate_tick_ms_) / static_cast<double>(rate_ticks_));
    rate_tick_ms_ = total_ms;
    rate_ticks_ = 0;
    rate_start_s_ = now_s();
}

void App::draw_overlays(const Input& input) {
    const double frame_ms = input.dt_s * 1000;
    frame_ms_ = frame_ms_ <= 0 ? frame_ms : frame_ms_ + (frame_ms - frame_ms_) / 8;
    if (settings_.overlay)
        draw_overlay({.frame_ms = frame_ms_,
                      .passes = timers_.passes(),
                      .ticks_per_s = ticks_per_s_,
                      .ticks_per_s_wanted = settings_.ticks_per_second * clock_.speed(),
                      .paused = clock_.paused(),
                      .tick = simulation_->tick(),
                      .size_vox = simulation_->size_vox(),
                      .census = simulation_->recent_census(),
                      .active_bricks = simulation_->recent_active_bricks(),
                      .samples = renderer_->samples(),
                      .error = renderer_->estimated_error(false),
                      .rejected_samples = rejected_samples_,
                      .brush = tools_.brush});
    if (settings_.view != ViewKind::Picture) draw_legend(settings_.view);
    if (!shader_error_.empty())
        draw_message(shader_error_, true);
    else if (now_s() < message_until_s_)
        draw_message(message_, false);
    else if (!eye_hint_.empty())
        draw_message(eye_hint_, false);
}

}  // namespace tarn
