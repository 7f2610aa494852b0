// Headless: an EGL surfaceless context. No window system, no surface, no configuration.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>  // setenv is POSIX

#include "core/error.h"
#include "gl/context.h"
#include "platform/platform.h"

namespace tarn {

namespace {

constexpr EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         4,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         5,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_CONTEXT_OPENGL_DEBUG,
                                         EGL_TRUE,
                                         EGL_NONE};

class SharedEglContext : public gl::SharedContext {
  public:
    SharedEglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    ~SharedEglContext() override { eglDestroyContext(display_, context_); }
    SharedEglContext(const SharedEglContext&) = delete;
    SharedEglContext& operator=(const SharedEglContext&) = delete;
    void make_current() override {
        // The API is bound by thread.
        if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
            fail("EGL: cannot use the shared context (error {:#x})", eglGetError());
    }
    void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  private:
    EGLDisplay display_;
    EGLContext context_;
};

class EglContext {
  public:
    EglContext() {
        // Mesa's own lines on stderr would hide ours.
        setenv("EGL_LOG_LEVEL", "fatal", 0);
        display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE)
            fail("EGL: no surfaceless display (error {:#x}); an OpenGL 4.5 driver such as Mesa's is needed",
                 eglGetError());
        if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
            fail("EGL: the driver has no desktop OpenGL; 4.5 core is needed");
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, context_attributes);
        if (context_ == EGL_NO_CONTEXT) {
            const EGLint error = eglGetError();
            fail_if_old();
            eglTerminate(display_);
            fail("EGL: no OpenGL 4.5 core context (error {:#x}); a driver with OpenGL 4.5 is needed", error);
        }
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
            fail("EGL: cannot use the context without a surface (error {:#x})", eglGetError());
        gl::load(eglGetProcAddress);
    }
    ~EglContext() {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    std::unique_ptr<gl::SharedContext> make_shared() const {
        const EGLContext shared = eglCreateContext(display_, EGL_NO_CONFIG_KHR, context_, context_attributes);
        if (shared == EGL_NO_CONTEXT) return nullptr;
        return std::make_unique<SharedEglContext>(display_, shared);
    }

  private:
    // Throws the error that names the version where the driver has an OpenGL, but an older one.
    void fail_if_old() {
        const EGLint any_version[] = {EGL_NONE};
        const EGLContext old = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, any_version);
        if (old == EGL_NO_CONTEXT) return;
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, old) == EGL_TRUE)
            gl::load(eglGetProcAddress);
        eglDestroyContext(display_, old);
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

class Headless : public Platform {
  public:
    Headless(glm::ivec2 size_px, int frames) : size_px_(size_px), frames_(frames) {}

    std::optional<Input> next_frame() override {
        if (frames_-- <= 0) return std::nullopt;
        Input input;
        input.size_px = size_px_;
        return input;
    }
    void present(const gl::Texture& /*picture*/) override {}
    void capture_mouse(bool /*captured*/) override {}
    void set_vsync(bool /*on*/) override {}
    void set_title(const std::string& /*title*/) override {}
    std::unique_ptr<gl::SharedContext> make_shared_context() override { return context_.make_shared(); }

  private:
    EglContext context_;
    glm::ivec2 size_px_;
    int frames_;
};

}  // namespace

std::unique_ptr<Platform> make_headless(glm::ivec2 size_px, int frames) {
    return std::make_unique<Headless>(size_px, frames);
}

}  // namespace tarn
