#include "measure/water_stepper.h"

#include "app/simulation.h"
#include "reference/simulation.h"

namespace tarn {

namespace {

class GpuStepper : public WaterStepper {
  public:
    GpuStepper(const Scene& scene, const StepperOptions& options)
        : settings_(options.settings), simulation_(scene, timers_) {
        simulation_.set_always_awake(options.awake);
    }

    void tick() override {
        simulation_.step(1, settings_);
        timers_.end_frame();
        glFinish();
    }
    Cells read() override { return simulation_.read_cells(); }
    void write(const std::vector<CellChange>& changes) override { simulation_.write(changes); }
    std::optional<std::uint32_t> active_bricks() override { return simulation_.active_bricks(); }

  private:
    Settings settings_;
    gl::Timers timers_;
    Simulation simulation_;
};

class ReferenceStepper : public WaterStepper {
  public:
    ReferenceStepper(const Scene& scene, const StepperOptions& options)
        : settings_(options.settings), simulation_(scene) {
        simulation_.set_always_awake(options.awake);
    }

    void tick() override { simulation_.step(1, settings_); }
    Cells read() override { return simulation_.cells(); }
    void write(const std::vector<CellChange>& changes) override {
        for (const CellChange& change : changes) simulation_.write(change.cell, change.after);
    }
    std::optional<std::uint32_t> active_bricks() override {
        return static_cast<std::uint32_t>(simulation_.active_bricks());
    }

  private:
    Settings settings_;
    reference::Simulation simulation_;
};

}  // namespace

std::unique_ptr<WaterStepper> make_gpu_stepper(const Scene& scene, const StepperOptions& options) {
    return std::make_unique<GpuStepper>(scene, options);
}

std::unique_ptr<WaterStepper> make_reference_stepper(const Scene& scene, const StepperOptions& options) {
    return std::make_unique<ReferenceStepper>(scene, options);
}

}  // namespace tarn
