// What the app sees of the outside: input in, one picture out. Two of them: a GLFW window and headless EGL.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gl/context.h"
#include "gl/texture.h"

namespace tarn {

// Keys that the app knows, whatever the window library calls them.
enum class Key {
    Forward,
    Back,
    Left,
    Right,
    Up,
    Down,
    Fast,
    Undo,
    Redo,
    Pause,
    Step,
    Faster,
    Slower,
    Reset,
    Home,  // the camera where the scene begins
    Help,
    Settings,
    Overlay,
    Screenshot,
    Record,         // starts or stops a recording
    View,           // the next one; with Fast the one before
    MouseLook,      // toggles
    MouseLookHold,  // while held
    Brush,
    Overwrite,
    Release,  // gives the mouse back, closes panels
    Digit1,
    Digit2,
    Digit3,
    Digit4,
    Digit5,
    Digit6,
    Digit7,
    Digit8,
    Digit9,
    Count
};
enum class MouseButton { Left, Right, Middle, Count };

struct Input {
    double dt_s = 0;                                                   // since the last frame; 0 headless
    glm::ivec2 size_px{1};                                             // of the picture to make; never 0
    std::array<bool, static_cast<std::size_t>(Key::Count)> down{};     // held now (not while a panel types)
    std::array<bool, static_cast<std::size_t>(Key::Count)> pressed{};  // went down since the last frame
    std::array<bool, static_cast<std::size_t>(MouseButton::Count)> mouse_down{};  // outside panels
    std::array<bool, static_cast<std::size_t>(MouseButton::Count)> mouse_pressed{};
    glm::vec2 mouse_px{0};          // from the top left
    bool mouse_on_picture = false;  // inside the window and over no panel
    glm::vec2 mouse_delta_px{0};
    float wheel = 0;           // steps, up positive
    bool interactive = false;  // true where somebody sees panels

    bool is_down(Key key) const { return down[static_cast<std::size_t>(key)]; }
    bool was_pressed(Key key) const { return pressed[static_cast<std::size_t>(key)]; }
    bool is_down(MouseButton button) const { return mouse_down[static_cast<std::size_t>(button)]; }
    bool was_pressed(MouseButton button) const { return mouse_pressed[static_cast<std::size_t>(button)]; }
};

class Platform {
  public:
    virtual ~Platform() = default;
    // Nothing means that the run ends.
    virtual std::optional<Input> next_frame() = 0;
    // `picture`: sRGB-encoded RGBA8, of the size that next_frame gave.
    virtual void present(const gl::Texture& picture) = 0;
    // Hides the cursor and reports relative motion while `captured`.
    virtual void capture_mouse(bool captured) = 0;
    virtual void set_vsync(bool on) = 0;
    virtual void set_title(const std::string& title) = 0;
    // For a thread that compiles; null where the driver has none to share. The platform must outlive it.
    virtual std::unique_ptr<gl::SharedContext> make_shared_context() = 0;
};

// Opens a window with an OpenGL 4.5 core context and ImGui. Throws Error where there is no display or no
// driver.
std::unique_ptr<Platform> make_window(glm::ivec2 size_px, const std::string& title);

// An EGL surfaceless OpenGL 4.5 core context and `frames` frames of `size_px`. Throws Error without a driver.
std::unique_ptr<Platform> make_headless(glm::ivec2 size_px, int frames);

// True where a window can be opened (DISPLAY or WAYLAND_DISPLAY leads somewhere).
bool has_display();

}  // namespace tarn
