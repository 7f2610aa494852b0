// The textures that a picture's size decides, and the framebuffers over them. Owned by the renderer.
#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "gl/framebuffer.h"
#include "gl/texture.h"
#include "shared/trace.h"

namespace tarn {

// What one frame sees; two sets, current and previous.
struct FrameTargets {
    gl::Texture surface;  // glsl/lib/surface.glsl
    gl::Texture history;

    FrameTargets() = default;
    explicit FrameTargets(glm::ivec2 size)
        : surface({.label = "surface", .format = GL_R32UI, .size = {size, 0}}),
          history({.label = "history", .format = GL_RGBA32F, .size = {size, 0}}) {}
};

// Sums of exact mode; two sets. The mean goes to `filtered`.
struct Sums {
    gl::Texture sum, correction;

    Sums() = default;
    explicit Sums(glm::ivec2 size)
        : sum({.label = "sum", .format = GL_RGBA32F, .size = {size, 0}}),
          correction({.label = "correction", .format = GL_RGBA32F, .size = {size, 0}}) {}
};

// Paths of the last frame, traced again: of one traced pixel in stride^2.
struct Retraced {
    int stride;
    gl::Texture paths;
    gl::Framebuffer target;

    Retraced(glm::ivec2 traced_px, int stride_px)
        : stride(stride_px),
          paths({.label = "retraced",
                 .format = GL_RGBA32F,
                 .size = {(traced_px + stride_px - 1) / stride_px, 0}}),
          target("retrace", {&paths}) {}
};

// Everything that depends on the picture's size. Upsampled: fewer pixels are traced than history keeps.
struct RenderTargets {
    glm::ivec2 traced_px, shown_px;
    bool exact, upsampled;
    gl::Texture radiance[2];  // traced; current and previous
    gl::Texture filtered[2], picture;
    gl::Texture traced_surface;           // upsampled
    gl::Texture antialiased;              // where asked for
    std::optional<Retraced> retraced[2];  // made when asked for; 1: after an edit
    FrameTargets frames[2];
    Sums sums[2];
    gl::Framebuffer trace_target[2], history_target[2], filter_target[2], sums_target[2], picture_target,
        antialias_target;

    RenderTargets(glm::ivec2 traced, glm::ivec2 shown, bool exact_mode, bool upsampled_mode)
        : traced_px(traced),
          shown_px(shown),
          exact(exact_mode),
          upsampled(upsampled_mode),
          picture({.label = "picture", .format = GL_RGBA8, .size = {shown, 0}}),
          picture_target("picture", {&picture}) {
        const glm::ivec2 kept = kept_px();
        for (gl::Texture& texture : filtered)
            texture = gl::Texture({.label = "filtered", .format = GL_RGBA32F, .size = {kept, 0}});
        if (upsampled)
            traced_surface =
                gl::Texture({.label = "traced surface", .format = GL_R32UI, .size = {traced, 0}});
        for (int i = 0; i < 2; ++i) {
            radiance[i] = gl::Texture({.label = "radiance", .format = GL_RGBA32F, .size = {traced, 0}});
            frames[i] = FrameTargets(kept);
            trace_target[i] = gl::Framebuffer("trace", {&radiance[i], &traced_surface_of(i)});
            history_target[i] = upsampled
                                    ? gl::Framebuffer("history", {&frames[i].history, &frames[i].surface})
                                    : gl::Framebuffer("history", {&frames[i].history});
            filter_target[i] = gl::Framebuffer("filter", {&filtered[i]});
            if (exact) sums[i] = Sums(traced);
        }
        if (!exact) return;
        for (int i = 0; i < 2; ++i)
            sums_target[i] = gl::Framebuffer("sums", {&sums[i].sum, &sums[i].correction, &filtered[i]});
    }
    void add_antialiased() {
        antialiased = gl::Texture({.label = "antialiased", .format = GL_RGBA32F, .size = {kept_px(), 0}});
        antialias_target = gl::Framebuffer("antialias", {&antialiased});
    }
    const Retraced& retraced_after(bool edit) {
        std::optional<Retraced>& paths = retraced[edit ? 1 : 0];
        if (!paths)
            paths.emplace(traced_px, static_cast<int>(edit ? RETRACE_STRIDE_OF_EDITS : RETRACE_STRIDE));
        return *paths;
    }
    glm::ivec2 kept_px() const { return upsampled ? shown_px : traced_px; }
    const gl::Texture& traced_surface_of(int set) const {
        return upsampled ? traced_surface : frames[set].surface;
    }
};

}  // namespace tarn
