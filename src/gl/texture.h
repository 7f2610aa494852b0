// A GL texture with immutable storage, 2D or 3D. Move-only owner of one name.
#pragma once
#include <glad/gl.h>

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace tarn::gl {

struct TextureDesc {
    const char* label = "";
    GLenum format = GL_RGBA8;  // sized internal format
    glm::ivec3 size{1, 1, 0};  // z = 0: a 2D texture
    bool linear = false;       // bilinear filtering; nearest otherwise. Always clamped to the edge.
};

class Texture {
  public:
    Texture() = default;
    // Throws Error where GPU memory does not suffice.
    explicit Texture(const TextureDesc& desc);
    ~Texture();
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;

    GLuint name() const { return name_; }
    glm::ivec3 size() const { return size_; }  // z = 0 for 2D
    GLenum format() const { return format_; }
    explicit operator bool() const { return name_ != 0; }
    // A small one for which drivers compile the same code: llvmpipe asks which sides are powers of two.
    TextureDesc small_like() const;

    void bind(GLuint unit) const;
    void bind_image(GLuint unit, GLenum access) const;

    // Whole texture or the box [min, min + size); rows are tight. T's size and (layout, type) must match the
    // format.
    template <typename T>
    void upload(std::span<const T> data, GLenum layout, GLenum type) {
        upload_bytes({}, size_, std::as_bytes(data), layout, type);
    }
    template <typename T>
    void upload(glm::ivec3 min, glm::ivec3 size, std::span<const T> data, GLenum layout, GLenum type) {
        upload_bytes(min, size, std::as_bytes(data), layout, type);
    }
    // Waits for the GPU.
    template <typename T>
    void download(std::span<T> data, GLenum layout, GLenum type) const {
        download_bytes({}, size_, std::as_writable_bytes(data), layout, type);
    }
    template <typename T>
    void download(glm::ivec3 min, glm::ivec3 size, std::span<T> data, GLenum layout, GLenum type) const {
        download_bytes(min, size, std::as_writable_bytes(data), layout, type);
    }
    void clear();

  private:
    void upload_bytes(glm::ivec3 min, glm::ivec3 size, std::span<const std::byte> data, GLenum layout,
                      GLenum type);
    void download_bytes(glm::ivec3 min, glm::ivec3 size, std::span<std::byte> data, GLenum layout,
                        GLenum type) const;

    GLuint name_ = 0;
    GLenum format_ = 0;
    glm::ivec3 size_{0};
    bool linear_ = false;
};

}  // namespace tarn::gl
