// What a scenario of water asks of a simulation: tick, read, write. Two of them: the GPU's and the serial
// reference's.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "world/edits.h"
#include "world/scene.h"

namespace tarn {

class WaterStepper {
  public:
    virtual ~WaterStepper() = default;
    // Ends when the tick is done, so that it can be timed.
    virtual void tick() = 0;
    virtual Cells read() = 0;
    virtual void write(const std::vector<CellChange>& changes) = 0;
    // Bricks that the next tick will look at; nothing where the stepper has no sleep.
    virtual std::optional<std::uint32_t> active_bricks() { return std::nullopt; }
};

struct StepperOptions {
    Settings settings;   // of the water
    bool awake = false;  // every brick is stepped, at rest or not
};

// Needs a current context.
std::unique_ptr<WaterStepper> make_gpu_stepper(const Scene& scene, const StepperOptions& options);
std::unique_ptr<WaterStepper> make_reference_stepper(const Scene& scene, const StepperOptions& options);

using MakeStepper = std::function<std::unique_ptr<WaterStepper>(const Scene&, const StepperOptions&)>;

}  // namespace tarn
