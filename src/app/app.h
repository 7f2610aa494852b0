// The game: a scene that runs, the picture of it, the player's tools and panels. frame() does the ten steps
// of a frame in order. Sees the outside through platform.h only.
#pragma once
#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "app/camera.h"
#include "app/flight_recorder.h"
#include "app/frame_times.h"
#include "app/governor.h"
#include "app/panels.h"
#include "app/renderer.h"
#include "app/simulation.h"
#include "app/tick_clock.h"
#include "app/tools.h"
#include "gl/timers.h"
#include "passes/trace_programs.h"
#include "platform/platform.h"

namespace tarn {

class App {
  public:
    struct Options {
        bool interactive = false;      // panels, tools and the clock; else ticks_per_frame only
        Platform* platform = nullptr;  // for the mouse, vsync and title; must outlive the app
    };

    // Throws Error when the world does not fit the driver.
    App(Scene scene, const Settings& settings, Options options);
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    // One frame: input in, the picture out. The texture stays the app's.
    const gl::Texture& frame(const Input& input);

    // Another built-in scene or scene file, in place of this one: its camera, water, sun and sky, the other
    // settings as they are. Throws Error and keeps what is there.
    void load(const std::string& name_or_path);
    // The scene's cells from the start; tick, undo and counts too.
    void reload();

    const Settings& settings() const { return settings_; }
    Simulation& simulation() { return *simulation_; }
    Renderer& renderer() { return *renderer_; }
    gl::Timers& timers() { return timers_; }

    // app/stats.h's JSON with `frames`, `gl_errors` and, in a window, `brush` and `panels_shown`. Waits for
    // the GPU.
    std::string stats_json();

  private:
    void poll_shaders();
    void change_settings(const Input& input, Actions& actions);
    void govern(const Input& input);
    void fly_in_world(const Input& input);
    void watch_eye();  // says so where it is in a solid
    void go_home();
    void run_actions(const Actions& actions);
    Pick pick(glm::ivec2 size_px, glm::vec2 at_px, bool through_water);
    void edit(const Input& input);
    glm::vec3 outline_color(const Brush& brush) const;  // linear
    void advance(const Input& input);
    void draw_overlays(const Input& input);
    void write_screenshot();
    void start_or_stop_recording();
    void end_recording();  // before the world is another
    void say(const std::string& text);
    void set_captured(bool captured);
    void set_title();
    double now_s() const;

    Options options_;
    gl::Timers timers_;
    Scene scene_;
    Settings settings_;
    Settings rendered_;  // of the last frame: what changed since may restart the history
    TracePrograms trace_programs_;
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Renderer> renderer_;
    EditHistory history_;
    Tools tools_;
    TickClock clock_;
    Panels panels_;
    FrameTimes frame_times_;
    Governor governor_;
    FlightRecorder recorder_;
    std::vector<RecordedEdit> frame_edits_;  // of this frame, undo and redo too
    std::vector<SceneSummary> scenes_;       // read when first shown

    bool look_toggled_ = false;
    bool captured_ = false;
    std::string message_, shader_error_, eye_hint_;
    double message_until_s_ = 0;
    double next_poll_s_ = 0;
    double next_error_s_ = 0;
    std::uint64_t next_error_frame_ = 0;
    std::uint64_t frames_ = 0;
    std::uint64_t rejected_samples_ = 0;
    double frame_ms_ = 0;  // smoothed
    double ticks_per_s_ = 0;
    std::uint64_t rate_ticks_ = 0;  // run since rate_start_s_
    double rate_tick_ms_ = 0;       // GPU time of all ticks by then
    double rate_start_s_ = 0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tarn
