// What comes last of a preset's picture: edges, smoothed from the surfaces that the frame keeps.
#include "app/renderer_parts.h"

namespace tarn {

const gl::Texture& Renderer::Parts::smooth_edges(const Simulation& simulation, const gl::Texture& radiance) {
    // Of jittered samples one surface is known, their light is of all.
    const bool averages = settings.jitter || settings.history == History::Exact;
    if (settings.antialiasing == 0 || averages || settings.view != ViewKind::Picture) return radiance;
    if (!targets->antialiased) targets->add_antialiased();
    built(antialias).record({.surfaces = surfaces(current, radiance),
                             .cells = simulation.cells(),
                             .samples = settings.antialiasing},
                            {.smooth = targets->antialias_target}, timers);
    return targets->antialiased;
}

}  // namespace tarn
