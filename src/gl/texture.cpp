#include "gl/texture.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/error.h"

namespace tarn::gl {

Texture::Texture(const TextureDesc& desc) : format_(desc.format), size_(desc.size), linear_(desc.linear) {
    const bool volume = size_.z > 0;
    CHECK(size_.x > 0 && size_.y > 0);
    glCreateTextures(volume ? GL_TEXTURE_3D : GL_TEXTURE_2D, 1, &name_);
    if (volume)
        glTextureStorage3D(name_, 1, format_, size_.x, size_.y, size_.z);
    else
        glTextureStorage2D(name_, 1, format_, size_.x, size_.y);
    if (glGetError() == GL_OUT_OF_MEMORY) {
        glDeleteTextures(1, &name_);
        fail("texture {} of {}x{}x{}: out of GPU memory", desc.label, size_.x, size_.y, size_.z);
    }
    const GLint filter = desc.linear ? GL_LINEAR : GL_NEAREST;
    glTextureParameteri(name_, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(name_, GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(name_, wrap, GL_CLAMP_TO_EDGE);
    glObjectLabel(GL_TEXTURE, name_, -1, desc.label);
}

Texture::~Texture() {
    if (name_ != 0) glDeleteTextures(1, &name_);
}

Texture::Texture(Texture&& other) noexcept
    : name_(std::exchange(other.name_, 0)),
      format_(other.format_),
      size_(other.size_),
      linear_(other.linear_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(format_, other.format_);
    std::swap(size_, other.size_);
    std::swap(linear_, other.linear_);
    return *this;
}

TextureDesc Texture::small_like() const {
    const auto side = [](int px) {
        return px > 1 ? std::has_single_bit(static_cast<unsigned>(px)) ? 2 : 3 : px;
    };
    return {.label = "small",
            .format = format_,
            .size = {side(size_.x), side(size_.y), side(size_.z)},
            .linear = linear_};
}

void Texture::bind(GLuint unit) const {
    glBindTextureUnit(unit, name_);
}

void Texture::bind_image(GLuint unit, GLenum access) const {
    glBindImageTexture(unit, name_, 0, size_.z > 0 ? GL_TRUE : GL_FALSE, 0, access, format_);
}

void Texture::upload_bytes(glm::ivec3 min, glm::ivec3 size, std::span<const std::byte> data, GLenum layout,
                           GLenum type) {
    const std::size_t texels = std::size_t{1} * size.x * size.y * std::max(size.z, 1);
    CHECK(!data.empty() && data.size() % texels == 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (size_.z > 0)
        glTextureSubImage3D(name_, 0, min.x, min.y, min.z, size.x, size.y, size.z, layout, type, data.data());
    else
        glTextureSubImage2D(name_, 0, min.x, min.y, size.x, size.y, layout, type, data.data());
}

void Texture::download_bytes(glm::ivec3 min, glm::ivec3 size, std::span<std::byte> data, GLenum layout,
                             GLenum type) const {
    CHECK(data.size() <= 0x7fffffffu);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureSubImage(name_, 0, min.x, min.y, min.z, size.x, size.y, std::max(size.z, 1), layout, type,
                         static_cast<GLsizei>(data.size()), data.data());
}

void Texture::clear() {
    // A null pointer fills with zeros whatever the format's class, as long as layout matches the class.
    const bool integer = format_ == GL_R8UI || format_ == GL_RG8UI || format_ == GL_R32UI ||
                         format_ == GL_RG32UI || format_ == GL_RGBA32UI || format_ == GL_R16UI ||
                         format_ == GL_RGBA8UI;
    glClearTexImage(name_, 0, integer ? GL_RED_INTEGER : GL_RED, integer ? GL_UNSIGNED_BYTE : GL_FLOAT,
                    nullptr);
}

}  // namespace tarn::gl
