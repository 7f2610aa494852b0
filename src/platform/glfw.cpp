// The window: GLFW 3.3, an OpenGL 4.5 core context, and the ImGui frame on top of the picture. Owns the GLFW
// window and the ImGui context; knows no panel.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "gl/context.h"
#include "gl/framebuffer.h"
#include "platform/platform.h"

namespace tarn {

namespace {

struct KeyBinding {
    int code;  // GLFW's; names the place on a US keyboard
    Key key;
};

constexpr KeyBinding key_bindings[] = {
    {GLFW_KEY_W, Key::Forward},       {GLFW_KEY_UP, Key::Forward},
    {GLFW_KEY_S, Key::Back},          {GLFW_KEY_DOWN, Key::Back},
    {GLFW_KEY_A, Key::Left},          {GLFW_KEY_LEFT, Key::Left},
    {GLFW_KEY_D, Key::Right},         {GLFW_KEY_RIGHT, Key::Right},
    {GLFW_KEY_SPACE, Key::Up},        {GLFW_KEY_C, Key::Down},  // not Ctrl: undo by Ctrl+Z would sink the eye
    {GLFW_KEY_LEFT_SHIFT, Key::Fast}, {GLFW_KEY_RIGHT_SHIFT, Key::Fast},
    {GLFW_KEY_Z, Key::Undo},          {GLFW_KEY_Y, Key::Redo},
    {GLFW_KEY_P, Key::Pause},         {GLFW_KEY_PAUSE, Key::Pause},
    {GLFW_KEY_N, Key::Step},          {GLFW_KEY_PERIOD, Key::Step},
    {GLFW_KEY_EQUAL, Key::Faster},    {GLFW_KEY_KP_ADD, Key::Faster},
    {GLFW_KEY_MINUS, Key::Slower},    {GLFW_KEY_KP_SUBTRACT, Key::Slower},
    {GLFW_KEY_R, Key::Reset},         {GLFW_KEY_H, Key::Help},
    {GLFW_KEY_F1, Key::Help},         {GLFW_KEY_O, Key::Settings},
    {GLFW_KEY_F2, Key::Settings},     {GLFW_KEY_F3, Key::Overlay},
    {GLFW_KEY_F12, Key::Screenshot},  {GLFW_KEY_V, Key::View},
    {GLFW_KEY_TAB, Key::MouseLook},   {GLFW_KEY_M, Key::MouseLook},
    {GLFW_KEY_F, Key::MouseLookHold}, {GLFW_KEY_LEFT_ALT, Key::MouseLookHold},
    {GLFW_KEY_B, Key::Brush},         {GLFW_KEY_X, Key::Overwrite},
    {GLFW_KEY_ESCAPE, Key::Release},  {GLFW_KEY_1, Key::Digit1},
    {GLFW_KEY_2, Key::Digit2},        {GLFW_KEY_3, Key::Digit3},
    {GLFW_KEY_4, Key::Digit4},        {GLFW_KEY_5, Key::Digit5},
    {GLFW_KEY_6, Key::Digit6},        {GLFW_KEY_7, Key::Digit7},
    {GLFW_KEY_8, Key::Digit8},        {GLFW_KEY_9, Key::Digit9},
    {GLFW_KEY_F11, Key::Record},      {GLFW_KEY_HOME, Key::Home},
    {GLFW_KEY_G, Key::Home},
};

constexpr std::pair<int, MouseButton> button_bindings[] = {
    {GLFW_MOUSE_BUTTON_LEFT, MouseButton::Left},
    {GLFW_MOUSE_BUTTON_RIGHT, MouseButton::Right},
    {GLFW_MOUSE_BUTTON_MIDDLE, MouseButton::Middle},
};

bool repeats(Key key) {
    return key == Key::Step || key == Key::Faster || key == Key::Slower || key == Key::Undo ||
           key == Key::Redo;
}

// GLFW reports through a callback that carries no user pointer.
std::string& last_glfw_error() {
    static std::string text;
    return text;
}

void on_error(int /*code*/, const char* description) {
    last_glfw_error() = description;
    std::replace(last_glfw_error().begin(), last_glfw_error().end(), '\n', ' ');
}

// glfwInit to glfwTerminate, which are process-wide. One connection for has_display() and the window: an X
// server may reset itself when its last client leaves.
class Library {
  public:
    Library() {
        glfwSetErrorCallback(on_error);
        last_glfw_error().clear();
        if (glfwInit() == GLFW_FALSE)
            fail("window: no display ({}); start it where DISPLAY leads to an X server, or use `tarn render`",
                 last_glfw_error().empty() ? "GLFW does not start" : last_glfw_error());
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    // Starts GLFW on the first call; throws Error, and may be tried again.
    static void require() { static const Library instance; }
};

void set_hints() {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
}

// GLFW has no context without a window: this one is never shown.
class SharedGlfwContext : public gl::SharedContext {
  public:
    explicit SharedGlfwContext(GLFWwindow* window) : window_(window) {}
    ~SharedGlfwContext() override { glfwDestroyWindow(window_); }
    SharedGlfwContext(const SharedGlfwContext&) = delete;
    SharedGlfwContext& operator=(const SharedGlfwContext&) = delete;
    void make_current() override { glfwMakeContextCurrent(window_); }
    void release() override { glfwMakeContextCurrent(nullptr); }

  private:
    GLFWwindow* window_;
};

class WindowHandle {
  public:
    WindowHandle(glm::ivec2 size_px, const std::string& title) {
        Library::require();
        set_hints();
        last_glfw_error().clear();
        window_ = glfwCreateWindow(size_px.x, size_px.y, title.c_str(), nullptr, nullptr);
        if (window_ == nullptr)
            fail("window: no OpenGL 4.5 core context ({}); a driver with OpenGL 4.5 is needed",
                 last_glfw_error());
        glfwMakeContextCurrent(window_);
        try {
            gl::load(glfwGetProcAddress);
        } catch (...) {
            glfwDestroyWindow(window_);
            throw;
        }
    }
    ~WindowHandle() { glfwDestroyWindow(window_); }
    WindowHandle(const WindowHandle&) = delete;
    WindowHandle& operator=(const WindowHandle&) = delete;
    GLFWwindow* get() const { return window_; }

  private:
    GLFWwindow* window_ = nullptr;
};

class Window : public Platform {
  public:
    Window(glm::ivec2 size_px, const std::string& title) : handle_(size_px, title) {
        GLFWwindow* window = handle_.get();
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* w, int code, int /*scan*/, int action, int mods) {
            of(w).on_key(code, action, mods);
        });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int /*mods*/) {
            of(w).on_button(button, action);
        });
        glfwSetScrollCallback(
            window, [](GLFWwindow* w, double /*x*/, double y) { of(w).wheel_ += static_cast<float>(y); });
        glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).on_cursor({x, y}); });
        glfwSwapInterval(1);

        IMGUI_CHECKVERSION();
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;  // leave no imgui.ini in the user's folder
        ImGui::StyleColorsDark();
        ImGui::GetIO().FontGlobalScale = text_scale();
        // Installed after ours, so ImGui calls ours too.
        ImGui_ImplGlfw_InitForOpenGL(window, true);
        ImGui_ImplOpenGL3_Init("#version 450");
        last_frame_s_ = glfwGetTime();
    }
    ~Window() override {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }

    std::optional<Input> next_frame() override {
        pressed_ = {};
        mouse_pressed_ = {};
        wheel_ = 0;
        moved_ = {0, 0};
        glfwPollEvents();
        GLFWwindow* window = handle_.get();
        while (glfwWindowShouldClose(window) == GLFW_FALSE && is_hidden()) glfwWaitEventsTimeout(0.5);
        if (glfwWindowShouldClose(window) != GLFW_FALSE) return std::nullopt;

        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();

        Input input;
        input.interactive = true;
        input.size_px = framebuffer_size();
        const double now_s = glfwGetTime();
        input.dt_s = std::max(0.0, now_s - last_frame_s_);
        last_frame_s_ = now_s;
        // WantCaptureKeyboard would also take the keys while a slider is dragged.
        if (!ImGui::GetIO().WantTextInput) read_keys(input);
        read_mouse(input);
        return input;
    }

    void present(const gl::Texture& picture) override {
        const glm::ivec2 size = framebuffer_size();
        const glm::ivec3 from = picture.size();
        glDisable(GL_SCISSOR_TEST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        if (size.x > 0 && size.y > 0) {
            // Mesa asks for a resized window's new size at glViewport only; a blit alone keeps the old one.
            glViewport(0, 0, size.x, size.y);
            const gl::Framebuffer source("window: picture", {&picture});
            const bool same = from.x == size.x && from.y == size.y;
            glBlitNamedFramebuffer(source.name(), 0, 0, 0, from.x, from.y, 0, 0, size.x, size.y,
                                   GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
        }
        ImGui::Render();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        glfwSwapBuffers(handle_.get());
    }

    void capture_mouse(bool captured) override {
        if (captured == captured_) return;
        captured_ = captured;
        glfwSetInputMode(handle_.get(), GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
        // The cursor jumps on both changes: that is no movement of the hand.
        cursor_known_ = false;
        ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
        flags = captured ? flags | ImGuiConfigFlags_NoMouse : flags & ~ImGuiConfigFlags_NoMouse;
    }

    void set_vsync(bool on) override {
        if (vsync_ == on) return;
        vsync_ = on;
        glfwSwapInterval(on ? 1 : 0);
    }

    void set_title(const std::string& title) override { glfwSetWindowTitle(handle_.get(), title.c_str()); }

    std::unique_ptr<gl::SharedContext> make_shared_context() override {
        set_hints();
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        GLFWwindow* const hidden = glfwCreateWindow(1, 1, "Tarn: compiling", nullptr, handle_.get());
        if (hidden == nullptr) return nullptr;
        return std::make_unique<SharedGlfwContext>(hidden);
    }

  private:
    static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

    void on_key(int code, int action, int mods) {
        if (action == GLFW_RELEASE) return;
        if (code == GLFW_KEY_Q && (mods & GLFW_MOD_CONTROL) != 0)
            glfwSetWindowShouldClose(handle_.get(), GLFW_TRUE);
        // Shift counts for the key pressed with it, also where both are up again by the next frame.
        if ((mods & GLFW_MOD_SHIFT) != 0) pressed_[static_cast<std::size_t>(Key::Fast)] = true;
        for (const KeyBinding& binding : key_bindings) {
            if (binding.code != code || (action == GLFW_REPEAT && !repeats(binding.key))) continue;
            const bool redo = binding.key == Key::Undo && (mods & GLFW_MOD_SHIFT) != 0;
            pressed_[static_cast<std::size_t>(redo ? Key::Redo : binding.key)] = true;
        }
    }

    void on_button(int button, int action) {
        for (const auto& [code, mouse_button] : button_bindings) {
            if (code == button && action == GLFW_PRESS)
                mouse_pressed_[static_cast<std::size_t>(mouse_button)] = true;
        }
    }

    void on_cursor(glm::dvec2 at) {
        if (cursor_known_) moved_ += at - cursor_;
        cursor_ = at;
        cursor_known_ = true;
    }

    bool is_code_down(int code) const { return glfwGetKey(handle_.get(), code) == GLFW_PRESS; }

    void read_keys(Input& input) const {
        input.pressed = pressed_;
        input.down = pressed_;  // a key that came and went between two frames still counts for one
        for (const KeyBinding& binding : key_bindings) {
            if (is_code_down(binding.code)) input.down[static_cast<std::size_t>(binding.key)] = true;
        }
    }

    void read_mouse(Input& input) const {
        GLFWwindow* window = handle_.get();
        // Screen coordinates are not pixels on HiDPI displays.
        glm::ivec2 window_size{1};
        glfwGetWindowSize(window, &window_size.x, &window_size.y);
        const glm::vec2 px_per_unit = glm::vec2(input.size_px) / glm::vec2(glm::max(window_size, 1));
        glm::dvec2 at{0};
        glfwGetCursorPos(window, &at.x, &at.y);
        input.mouse_px = glm::vec2(at) * px_per_unit;
        input.mouse_delta_px = glm::vec2(moved_) * px_per_unit;
        if (!captured_ && ImGui::GetIO().WantCaptureMouse) return;
        input.mouse_on_picture = captured_ || glfwGetWindowAttrib(window, GLFW_HOVERED) != GLFW_FALSE;
        input.wheel = wheel_;
        input.mouse_pressed = mouse_pressed_;
        input.mouse_down = mouse_pressed_;
        for (const auto& [code, button] : button_bindings) {
            if (glfwGetMouseButton(window, code) == GLFW_PRESS)
                input.mouse_down[static_cast<std::size_t>(button)] = true;
        }
    }

    // X11 has no units but pixels, so text grows with the display's density; in quarters, for crisp letters.
    float text_scale() const {
        float scale = 1;
        glfwGetWindowContentScale(handle_.get(), &scale, nullptr);
        glm::ivec2 window_size{1};
        glfwGetWindowSize(handle_.get(), &window_size.x, &window_size.y);
        scale *= static_cast<float>(window_size.x) / static_cast<float>(std::max(framebuffer_size().x, 1));
        return std::max(1.f, std::round(scale * 4) / 4);
    }

    glm::ivec2 framebuffer_size() const {
        glm::ivec2 size{0};
        glfwGetFramebufferSize(handle_.get(), &size.x, &size.y);
        return size;
    }

    bool is_hidden() const {
        const glm::ivec2 size = framebuffer_size();
        return size.x <= 0 || size.y <= 0 || glfwGetWindowAttrib(handle_.get(), GLFW_ICONIFIED) != GLFW_FALSE;
    }

    WindowHandle handle_;
    decltype(Input::pressed) pressed_{};
    decltype(Input::mouse_pressed) mouse_pressed_{};
    float wheel_ = 0;
    glm::dvec2 cursor_{0}, moved_{0};  // in screen coordinates
    bool cursor_known_ = false;
    bool captured_ = false;
    bool vsync_ = true;
    double last_frame_s_ = 0;
};

}  // namespace

std::unique_ptr<Platform> make_window(glm::ivec2 size_px, const std::string& title) {
    return std::make_unique<Window>(size_px, title);
}

bool has_display() {
    try {
        Library::require();
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace tarn
