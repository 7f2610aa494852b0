#include "gl/framebuffer.h"

#include <array>
#include <utility>

#include "core/error.h"

namespace tarn::gl {

namespace {

// Core profile draws need a vertex array even where vertices come from gl_VertexID alone. One per context;
// freed with it.
GLuint empty_vertex_array() {
    GLint bound = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &bound);
    if (bound != 0) return static_cast<GLuint>(bound);
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return name;
}

}  // namespace

Framebuffer::Framebuffer(const char* label, std::initializer_list<const Texture*> attachments) {
    CHECK(attachments.size() >= 1 && attachments.size() <= 8);
    glCreateFramebuffers(1, &name_);
    std::array<GLenum, 8> buffers{};
    GLenum count = 0;
    for (const Texture* texture : attachments) {
        size_ = glm::ivec2(texture->size());
        glNamedFramebufferTexture(name_, GL_COLOR_ATTACHMENT0 + count, texture->name(), 0);
        buffers[count] = GL_COLOR_ATTACHMENT0 + count;
        ++count;
    }
    glNamedFramebufferDrawBuffers(name_, static_cast<GLsizei>(count), buffers.data());
    glObjectLabel(GL_FRAMEBUFFER, name_, -1, label);
    const GLenum status = glCheckNamedFramebufferStatus(name_, GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    glDeleteFramebuffers(1, &name_);
    fail("framebuffer {} of {}x{}: the driver cannot draw into it (status {:#x}); out of GPU memory?", label,
         size_.x, size_.y, status);
}

Framebuffer::~Framebuffer() {
    if (name_ != 0) glDeleteFramebuffers(1, &name_);
}

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : name_(std::exchange(other.name_, 0)), size_(other.size_) {}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(size_, other.size_);
    return *this;
}

void Framebuffer::draw_rows(Rows rows) const {
    glBindFramebuffer(GL_FRAMEBUFFER, name_);
    glViewport(0, 0, size_.x, size_.y);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, rows.first, size_.x, rows.count);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(empty_vertex_array());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace tarn::gl
