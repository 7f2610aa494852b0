// The two windows, Help and Settings: ImGui widgets that change settings and the brush, and collect what else
// is asked of the app. Owns what is open; applies nothing else.
#pragma once
#include <optional>
#include <span>
#include <string>

#include "app/tools.h"
#include "core/settings.h"
#include "world/scene.h"

namespace tarn {

// What keys and panels ask of the app in one frame.
struct Actions {
    bool toggle_pause = false, step = false, faster = false, slower = false, reload = false;
    bool undo = false, redo = false, screenshot = false;
    bool record = false;                    // starts or stops
    bool home = false;                      // the camera where the scene begins
    std::optional<std::string> load_scene;  // a built-in name
};

class Panels {
  public:
    struct Inputs {
        Settings& settings;
        Brush& brush;
        const Settings& defaults;  // what "reset" returns to: the scene's
        const std::string& scene;
        std::span<const SceneSummary> scenes;
        bool paused, can_undo, can_redo;
        bool recording = false;
        double expected_ms = 0;  // of a frame where `tradeoff` stands; 0: not known
    };
    // Draws the open windows; between the platform's next_frame() and present().
    void draw(const Inputs& inputs, Actions& actions);

    bool help_open = false, settings_open = false;
    // True once the window's widgets have been on the screen.
    bool help_was_shown() const { return help_shown_; }
    bool settings_was_shown() const { return settings_shown_; }

  private:
    void draw_help();
    void draw_settings(const Inputs& inputs, Actions& actions);

    bool help_shown_ = false, settings_shown_ = false;
    bool help_was_open_ = false;
};

}  // namespace tarn
