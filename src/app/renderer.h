// Makes the picture of a Simulation: the frame's targets, the history, THE pass order. Owns its textures;
// changes no cell.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/simulation.h"
#include "core/image.h"
#include "core/settings.h"
#include "gl/texture.h"
#include "gl/timers.h"
#include "world/material_table.h"

namespace tarn {

class TracePrograms;
struct TraceFeatures;

// The voxel around the eye, be it of any medium but air; else the first surface that a ray from the eye
// meets.
struct Pick {
    bool hit = false;
    glm::ivec3 cell{0};    // the voxel hit
    glm::ivec3 normal{0};  // unit, towards the eye's side; 0 where the eye is inside the voxel
    std::uint8_t byte = 0;
};

class Renderer {
  public:
    // `programs`: shared with renderers of other scenes, and built beside the frames; null: its own, built
    // when needed.
    Renderer(const Scene& scene, gl::Timers& timers, TracePrograms* programs = nullptr);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // One picture of `size_px`, sRGB-encoded RGBA8. The texture stays the renderer's.
    const gl::Texture& render(const Simulation& simulation, const Settings& settings, glm::ivec2 size_px);

    // History starts anew with the next frame.
    void reset_history();
    // Another simulation, of the same scene, comes with the next frame.
    void world_replaced();

    // What the trace program can do though the scene has no need of it. For measurements and tests.
    void compile_in(const TraceFeatures& always);

    // Of the next frame: its random numbers follow from it. For tests of counter wrap.
    void set_frame_index(std::uint64_t index);

    // What lies under the pixel `at_px` (from the top left) of a picture of `size_px`. Waits for the GPU.
    // `through_water`: water is passed as if it were air, also by an eye within it.
    Pick pick(const Simulation& simulation, const Settings& settings, glm::ivec2 size_px, glm::vec2 at_px,
              bool through_water);
    // Likewise along a unit direction from the eye.
    Pick pick_along(const Simulation& simulation, const Settings& settings, glm::vec3 dir,
                    bool through_water);

    // Of the last render(); both wait for the GPU.
    ImageRgba8 read_picture() const;
    // Before exposure and tone mapping, at the shown size; of a view its raw values (settings_list.h), -1
    // where there is none.
    ImageRgb32f read_radiance() const;

    // Kept per pixel: of exact mode and of a refined picture all; else up to the cap.
    std::uint64_t samples() const;
    bool is_refining() const;                // the last frame was exact, of a picture at rest
    std::uint64_t rejected_samples() const;  // not finite, since the start
    // Keeps from the next frame on what an estimate needs.
    void keep_variance(bool on);
    // Measures the error of the picture last rendered, of this world; the answer comes frames later.
    void measure_error(const Simulation& simulation);
    // The estimated relMSE of the luminance (app/error_estimate.h). Nothing before the first answer. wait:
    // for the answer under way.
    std::optional<double> estimated_error(bool wait) const;
    double compile_ms() const;  // spent building programs so far

    std::vector<std::string> poll_reload();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tarn
