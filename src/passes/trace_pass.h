// Paths of one frame: radiance and the surface seen, per pixel. glsl/pass/trace.frag.
#pragma once
#include <array>
#include <compare>
#include <optional>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "passes/emitters.h"

namespace tarn {

// What the program must be able to do; what is left out costs nothing. glsl/lib/path.glsl explains each.
struct TraceFeatures {
    bool skip = false;          // over empty bricks; otherwise voxel by voxel
    bool clear = false;         // water or glass
    bool rough = false;         // some of it rough
    bool coated = false;        // opaque materials with an interface, metals
    bool sun = false;           // sampled
    bool sky = false;           // sampled
    bool emitters = false;      // emissive voxels, sampled
    bool smooth_water = false;  // levels of neighbouring voxels shaded as one surface; with clear
    bool count = false;         // bounces and steps, for views
    auto operator<=>(const TraceFeatures&) const = default;
};

// What a driver's code for the pass may depend on beside its features.
struct TraceShapes {
    gl::TextureDesc cells, brick_rooms, brick_changed, albedo_table, metal_albedo_table, glass_albedo_table;
    std::array<gl::TextureDesc, 2> targets;  // radiance, surface
};

class TracePass {
  public:
    struct Inputs {
        const gl::Texture& cells;
        const gl::Texture& brick_rooms;
        const gl::Texture& albedo_table;
        const gl::Texture& metal_albedo_table;
        const gl::Texture& glass_albedo_table;
        const EmittersPass* emitters;  // null unless the feature is on
        const gl::Buffer& rejected;    // one uint, counted up
        const gl::Texture& brick_changed;
        std::uint32_t still_since;  // water in bricks that changed after this version of the world moves
        std::uint32_t stride = 1;   // of the pixels traced, along x and y
        // In place of each path, of a pixel that the previous frame next to never saw. 1: it is not read.
        std::uint32_t new_pixel_samples = 1;
        const gl::Texture* previous_radiance = nullptr;
        const gl::Texture* previous_surface = nullptr;
    };
    struct Outputs {
        const gl::Framebuffer& target;   // radiance, surface; with count: counts
        std::optional<gl::Rows> rows{};  // that are traced; the others keep what they hold
        const char* timed_as = "trace";
    };

    explicit TracePass(const TraceFeatures& features);
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    // Draws one pixel of no world, as record() would one of a world of these shapes: some drivers compile at
    // the first draw only, and may share what they made with other contexts. So for the emitters that its
    // features ask for. Features without count.
    void rehearse(const TraceShapes& shapes) const;
    const TraceFeatures& features() const { return features_; }
    gl::Program& program() { return program_; }

  private:
    void draw(const Inputs& inputs, const Outputs& outputs) const;

    TraceFeatures features_;
    gl::Program program_;
};

}  // namespace tarn
