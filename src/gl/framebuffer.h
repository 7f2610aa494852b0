// A framebuffer over textures it does not own, and the full-screen triangle. Move-only owner of one name.
#pragma once
#include <glad/gl.h>

#include <glm/glm.hpp>
#include <initializer_list>

#include "gl/texture.h"

namespace tarn::gl {

struct Rows {
    int first, count;
};

class Framebuffer {
  public:
    Framebuffer() = default;
    // Attachment i is the i-th texture; all have one size. Textures must outlive the framebuffer.
    // Throws Error where the driver cannot draw into them.
    Framebuffer(const char* label, std::initializer_list<const Texture*> attachments);
    ~Framebuffer();
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;

    GLuint name() const { return name_; }
    glm::ivec2 size() const { return size_; }
    explicit operator bool() const { return name_ != 0; }

    // Runs the bound render program once for every pixel.
    void draw_fullscreen() const { draw_rows({0, size_.y}); }
    // For those of some rows; the others keep what they hold.
    void draw_rows(Rows rows) const;

  private:
    GLuint name_ = 0;
    glm::ivec2 size_{0};
};

}  // namespace tarn::gl
