// A GL buffer with immutable storage. Move-only owner of one name.
#pragma once
#include <glad/gl.h>

#include <cstddef>
#include <span>

namespace tarn::gl {

class Buffer {
  public:
    Buffer() = default;
    // `bytes` > 0; contents zero.
    Buffer(const char* label, std::size_t bytes);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    GLuint name() const { return name_; }
    std::size_t bytes() const { return bytes_; }
    explicit operator bool() const { return name_ != 0; }

    void bind_uniform(GLuint index) const { glBindBufferBase(GL_UNIFORM_BUFFER, index, name_); }
    void bind_storage(GLuint index) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, index, name_); }

    // `data`: a span, array or vector.
    template <typename Range>
    void upload(const Range& data, std::size_t offset_bytes = 0) {
        upload_bytes(std::as_bytes(std::span(data)), offset_bytes);
    }
    // Waits for the GPU.
    template <typename T>
    void download(std::span<T> data, std::size_t offset_bytes = 0) const {
        download_bytes(std::as_writable_bytes(data), offset_bytes);
    }
    void clear();

  private:
    void upload_bytes(std::span<const std::byte> data, std::size_t offset_bytes);
    void download_bytes(std::span<std::byte> data, std::size_t offset_bytes) const;

    GLuint name_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace tarn::gl
