// Emissive voxels as lights that can be sampled: a tree over the bricks that hold them, kept up to date for
// changed bricks only (glsl/pass/emitter_*.comp), read by lib/emitters.glsl. Owns its buffers and programs.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "passes/changes.h"
#include "shared/emitters.h"

namespace tarn {

// Where each level of the tree lies; the head of its buffer.
struct EmitterTreeHead {
    std::array<glm::ivec4, EMITTER_LEVELS_MAX> levels{};  // xyz: nodes along each side; w: index of the first
    glm::ivec4 depth{0};                                  // x: levels
};

// The tree over `size_bricks` (at most 256 a side); and how many nodes it has.
EmitterTreeHead emitter_tree_head(glm::ivec3 size_bricks);
std::size_t emitter_node_count(const EmitterTreeHead& head);

class EmittersPass {
  public:
    struct Inputs {
        const gl::Texture& cells;  // R8UI
        const ChangeLog& changes;
        std::uint32_t version;  // of the world
    };

    explicit EmittersPass(glm::ivec3 size_bricks);

    // Looks at the bricks that changed since the last call, at all in the first. The materials' block is
    // bound.
    void record(const Inputs& in, gl::Timers& timers);
    // For a program with lib/emitters.glsl.
    void bind() const;
    const gl::Buffer& tree() const { return tree_; }    // EmitterTreeHead, then a float a node
    const gl::Buffer& masks() const { return masks_; }  // 64 bits a brick
    void poll_reload(std::vector<std::string>& messages);

  private:
    EmitterTreeHead head_;
    ChangeReader reader_;
    gl::Program bricks_program_, tree_program_;
    gl::Buffer tree_, masks_, groups_;
    std::uint32_t seen_version_ = 0;
    bool seen_any_ = false;
};

}  // namespace tarn
