#include "bench/ray_kernel.h"

#include "app/stopwatch.h"
#include "shared/bindings.h"
#include "shared/frame.h"

namespace tarn {

namespace {

constexpr int width_px = 640;  // a multiple of the tile's
constexpr int tile_width_px = 4, tile_height_px = 2;
constexpr int tiles_per_row = width_px / tile_width_px;

gl::Program make_program(bool from_eye, bool skip) {
    gl::ProgramDesc desc{.label = "bench rays",
                         .compute = {},
                         .vertex = "pass/fullscreen.vert",
                         .fragment = "pass/rays.frag",
                         .defines = {}};
    if (from_eye) desc.defines.emplace_back("RAYS_FROM_EYE", "1");
    if (skip) desc.defines.emplace_back("TRAVERSAL_SKIP", "1");
    return gl::Program(desc);
}

int rows_for(std::size_t rays) {
    constexpr std::size_t rays_per_row = std::size_t{8} * tiles_per_row;
    return static_cast<int>((rays + rays_per_row - 1) / rays_per_row) * tile_height_px;
}

std::size_t place_of(std::size_t ray) {
    const std::size_t tile = ray / 8;
    const std::size_t x = tile % tiles_per_row * tile_width_px + ray % 4;
    const std::size_t y = tile / tiles_per_row * tile_height_px + ray % 8 / 4;
    return x + y * width_px;
}

}  // namespace

RayKernel::RayKernel(const RaySet& set, bool skip)
    : count_(set.rays.size()),
      program_(make_program(set.from_eye, skip)),
      rows_(rows_for(set.rays.size())),
      rays_({.label = "bench rays", .format = GL_RGBA32F, .size = {width_px, 3 * rows_, 0}}),
      frame_("bench frame", sizeof(FrameBlock)),
      result_({.label = "bench distances", .format = GL_RGBA32F, .size = {width_px, rows_, 0}}),
      target_("bench distances", {&result_}) {
    const std::size_t pixels = std::size_t{1} * width_px * rows_;
    std::vector<glm::vec4> parts(3 * pixels, glm::vec4(0));
    for (std::size_t ray = 0; ray < count_; ++ray) {
        const BenchRay& from = set.rays[ray];
        parts[place_of(ray)] = from.origin_vox;
        parts[pixels + place_of(ray)] = from.dir;
        parts[2 * pixels + place_of(ray)] = glm::vec4(from.cell);
    }
    rays_.upload<glm::vec4>(parts, GL_RGBA, GL_FLOAT);
    program_.set("rows", rows_);
}

double RayKernel::run(const Simulation& simulation) {
    FrameBlock block;
    block.world_size_vox = glm::ivec4(simulation.size_vox(), 0);
    frame_.upload(std::span(&block, 1));
    frame_.bind_uniform(BINDING_FRAME);
    simulation.cells().bind_image(IMAGE_CELLS, GL_READ_ONLY);
    simulation.brick_rooms().bind_image(IMAGE_BRICK_ROOMS, GL_READ_ONLY);
    rays_.bind_image(IMAGE_BENCH_RAYS, GL_READ_ONLY);
    program_.use();
    glFinish();
    const Stopwatch watch;
    target_.draw_fullscreen();
    glFinish();
    return watch.ms();
}

RayKernel::Result RayKernel::read() const {
    const glm::ivec3 size = result_.size();
    std::vector<glm::vec4> pixels(std::size_t{1} * size.x * size.y);
    result_.download(std::span(pixels), GL_RGBA, GL_FLOAT);
    Result result;
    for (std::size_t ray = 0; ray < count_; ++ray) {
        const glm::vec4 found = pixels[place_of(ray)];
        result.distance_vox.push_back(found.x);
        result.mean_steps += static_cast<double>(found.y) / static_cast<double>(count_);
        result.mean_cells += static_cast<double>(found.z) / static_cast<double>(count_);
    }
    return result;
}

}  // namespace tarn
