// Tarn's rays for the benchmark: the shipped walk over a list of rays (glsl/pass/rays.frag).
#pragma once
#include <vector>

#include "app/simulation.h"
#include "bench/ray_sets.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"

namespace tarn {

class RayKernel {
  public:
    // `skip`: over empty bricks; otherwise voxel by voxel.
    RayKernel(const RaySet& set, bool skip);

    // Milliseconds by wall clock, until the GPU is done.
    double run(const Simulation& simulation);

    struct Result {
        std::vector<float> distance_vox;  // of each ray; -1: nothing met
        double mean_steps = 0;
        double mean_cells = 0;  // read
    };
    Result read() const;  // of the last run

  private:
    std::size_t count_;
    gl::Program program_;
    int rows_;
    gl::Texture rays_;  // as glsl/pass/rays.frag reads it
    gl::Buffer frame_;
    gl::Texture result_;
    gl::Framebuffer target_;
};

}  // namespace tarn
