// Scenes for tests of what comes after the trace pass, and a renderer of one's own for each.
#pragma once
#include <algorithm>
#include <vector>

#include "picture.h"
#include "world/edits.h"

namespace tarn {

// Exact mode's light without history and filter: noise is as the scene makes it.
inline void plain(Settings& s) {
    apply_quality(s, Quality::Exact);
    s.history = History::None;
    s.filter = Filter::None;
    s.jitter = false;
}

// A scene with the simulation and the renderer of its own.
struct Studio {
    Scene scene;
    gl::Timers timers;
    Simulation simulation;
    Renderer renderer;

    explicit Studio(Scene scene_)
        : scene(std::move(scene_)), simulation(scene, timers), renderer(scene, timers) {}

    Settings& settings() { return scene.settings; }
    Picture shoot(glm::ivec2 size_px) {
        renderer.render(simulation, scene.settings, size_px);
        return {renderer.read_radiance(), renderer.rejected_samples()};
    }
};

// mean((x - ref)^2 / (ref^2 + 0.01 mean(ref)^2)) over the pixels that are `counted`; empty: all.
inline double relative_error(const Picture& picture, const Picture& reference,
                             const std::vector<char>& counted = {}) {
    double mean = 0;
    for (const float p : reference.image.pixels) mean += p;
    mean /= static_cast<double>(reference.image.pixels.size());
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
        if (!counted.empty() && counted[i / 3] == 0) continue;
        const double expected = reference.image.pixels[i];
        sum += std::pow(picture.image.pixels[i] - expected, 2) / (expected * expected + 0.01 * mean * mean);
        ++count;
    }
    return sum / count;
}

inline void put(Studio& studio, glm::ivec3 center_vox, int radius_vox, std::uint8_t material) {
    EditHistory edits;
    edits.begin_stroke();
    studio.simulation.apply({.shape = BrushShape::Cube,
                             .center_vox = center_vox,
                             .radius_vox = radius_vox,
                             .material = material,
                             .overwrite = true},
                            edits);
}

inline Scene plain_scene(const std::string& text) {
    Scene scene = scene_from(text);
    plain(scene.settings);
    return scene;
}

// A floor under a bright sky, seen straight down: one surface, all noise.
inline Scene noisy_floor() {
    Scene scene = plain_scene(R"({"size": [32, 12, 32],
        "camera": {"position_vox": [16, 11, 16], "pitch_deg": -90, "fov_deg": 40}, "sun": {"irradiance": [0, 0, 0]},
        "sky": {"zenith": [3, 2, 1], "horizon": [0, 0, 0]},
        "build": [{"box": {"min": [0, 0, 0], "max": [32, 1, 32], "material": "wall"}}]})");
    scene.settings.max_bounces = 1;
    return scene;
}

// A point sun, low over +x, and one bounce: no noise. Slabs of two materials stand in the sun, on several
// levels; the floor of the same materials lies in the shadow of a wall, so that materials, normals and planes
// all differ in radiance, and radiance is constant on each.
inline Scene sunlit_slabs() {
    Scene scene = plain_scene(R"({"size": [24, 20, 24],
        "camera": {"position_vox": [10, 34, 14], "pitch_deg": -80, "fov_deg": 38},
        "sun": {"azimuth_deg": 90, "elevation_deg": 10, "irradiance": [6, 6, 6], "angular_radius_deg": 0},
        "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"stone": {"base_color": [0.9, 0.1, 0.1]}, "dirt": {"base_color": [0.1, 0.2, 0.9]}},
        "build": [{"box": {"min": [0, 0, 0], "max": [24, 1, 24], "material": "stone"}},
                  {"box": {"min": [0, 0, 8], "max": [24, 1, 24], "material": "dirt"}},
                  {"box": {"min": [23, 0, 0], "max": [24, 9, 24], "material": "wall"}},
                  {"box": {"min": [4, 11, 4], "max": [10, 12, 10], "material": "stone"}},
                  {"box": {"min": [4, 11, 10], "max": [10, 12, 15], "material": "dirt"}},
                  {"box": {"min": [13, 15, 6], "max": [16, 16, 18], "material": "dirt"}}]})");
    scene.settings.max_bounces = 1;
    scene.settings.light_sampling = LightSampling::Lights;
    return scene;
}

// a (1 - w) + b w
inline Picture mixed(const Picture& a, const Picture& b, double w) {
    Picture result = a;
    for (std::size_t i = 0; i < a.image.pixels.size(); ++i)
        result.image.pixels[i] =
            static_cast<float>(a.image.pixels[i] + w * (double{b.image.pixels[i]} - a.image.pixels[i]));
    return result;
}

inline bool all_finite(const Picture& picture) {
    return std::ranges::all_of(picture.image.pixels, [](float p) { return std::isfinite(p); });
}

}  // namespace tarn
