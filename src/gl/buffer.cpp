#include "gl/buffer.h"

#include <utility>

#include "core/error.h"

namespace tarn::gl {

Buffer::Buffer(const char* label, std::size_t bytes) : bytes_(bytes) {
    CHECK(bytes > 0);
    glCreateBuffers(1, &name_);
    glNamedBufferStorage(name_, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    if (glGetError() == GL_OUT_OF_MEMORY) fail("buffer {} of {} bytes: out of GPU memory", label, bytes);
    glObjectLabel(GL_BUFFER, name_, -1, label);
    clear();
}

Buffer::~Buffer() {
    if (name_ != 0) glDeleteBuffers(1, &name_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : name_(std::exchange(other.name_, 0)), bytes_(std::exchange(other.bytes_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

void Buffer::upload_bytes(std::span<const std::byte> data, std::size_t offset_bytes) {
    CHECK(offset_bytes + data.size() <= bytes_);
    glNamedBufferSubData(name_, static_cast<GLintptr>(offset_bytes), static_cast<GLsizeiptr>(data.size()),
                         data.data());
}

void Buffer::download_bytes(std::span<std::byte> data, std::size_t offset_bytes) const {
    CHECK(offset_bytes + data.size() <= bytes_);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(name_, static_cast<GLintptr>(offset_bytes), static_cast<GLsizeiptr>(data.size()),
                            data.data());
}

void Buffer::clear() {
    glClearNamedBufferData(name_, GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
}

}  // namespace tarn::gl
