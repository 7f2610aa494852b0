#include "cli/ticks.h"

#include <algorithm>

#include "cli/progress.h"

namespace tarn {

void run_ticks(Simulation& simulation, const Settings& settings, std::uint64_t ticks, gl::Timers& timers) {
    Progress progress("ticks", ticks);
    constexpr std::uint64_t chunk = 64;
    for (std::uint64_t done = 0; done < ticks;) {
        const std::uint64_t n = std::min(chunk, ticks - done);
        simulation.step(static_cast<int>(n), settings);
        timers.end_frame();
        timers.finish();
        done += n;
        progress.show(done);
    }
}

}  // namespace tarn
