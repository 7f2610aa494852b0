// Pictures of scenes given as text, for tests of light: exact mode's mean radiance, without a window or a
// file.
#pragma once
#include <cmath>
#include <functional>
#include <string>

#include "app/renderer.h"
#include "app/simulation.h"
#include "gl_test.h"
#include "world/scene.h"

namespace tarn {

struct Picture {
    ImageRgb32f image;
    std::uint64_t rejected = 0;

    glm::dvec3 at(int x, int y) const {
        const float* p = &image.pixels[3 * (x + std::size_t{1} * y * image.width)];
        return {p[0], p[1], p[2]};
    }
    // Over all pixels.
    glm::dvec3 mean() const {
        glm::dvec3 sum(0);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) sum += at(x, y);
        return sum / (1.0 * image.width * image.height);
    }
    // Of the mean's red component, from the spread of the pixels.
    double standard_error() const {
        const double m = mean().x;
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) sum += (at(x, y).x - m) * (at(x, y).x - m);
        const double n = 1.0 * image.width * image.height;
        return std::sqrt(sum / (n * (n - 1)));
    }
    // Largest difference of any component from `value`.
    double worst(double value) const {
        double most = 0;
        for (const float p : image.pixels) most = std::max(most, std::abs(p - value));
        return most;
    }
};

inline double luminance(glm::dvec3 rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

// `frames` frames in quality exact with `change` applied to its settings.
inline Picture picture_of(Scene scene, int frames, glm::ivec2 size_px,
                          const std::function<void(Settings&)>& change = {}) {
    Settings exact;
    apply_quality(exact, Quality::Exact);
    for (const SettingInfo& info : setting_infos()) {
        const bool of_preset = info.group == SettingGroup::LIGHT || info.group == SettingGroup::IMAGE_FILTER;
        if (of_preset) info.set(scene.settings, info.get(exact));
    }
    if (change) change(scene.settings);
    gl::Timers timers;
    const Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    for (int i = 0; i < frames; ++i) renderer.render(simulation, scene.settings, size_px);
    return {renderer.read_radiance(), renderer.rejected_samples()};
}

inline Scene scene_from(const std::string& text) {
    return parse_scene(text, "test", Settings{});
}

}  // namespace tarn
