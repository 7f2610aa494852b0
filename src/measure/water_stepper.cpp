#include "measure/water_stepper.h"

#include "app/simulation.h"
#include "reference/water_block.h"

namespace tarn {

namespace {

class GpuStepper : public WaterStepper {
  public:
    GpuStepper(const Scene& scene, const StepperOptions& options)
        : settings_(options.settings), simulation_(scene, timers_) {}

    void tick() override {
        simulation_.step(1, settings_);
        timers_.end_frame();
        glFinish();
    }
    Cells read() override { return simulation_.read_cells(); }
    void write(const std::vector<CellChange>& changes) override { simulation_.write(changes); }

  private:
    Settings settings_;
    gl::Timers timers_;
    Simulation simulation_;
};

class ReferenceStepper : public WaterStepper {
  public:
    ReferenceStepper(const Scene& scene, const StepperOptions& options)
        : settings_(options.settings), seed_(scene.seed), cells_(scene.cells) {}

    void tick() override {
        switch (settings_.water_tier) {
            case WaterTier::Block:
                water_block_tick(cells_, seed_, tick_, settings_.film_threshold);
                break;
        }
        ++tick_;
    }
    Cells read() override { return cells_; }
    void write(const std::vector<CellChange>& changes) override {
        for (const CellChange& change : changes) cells_.at(change.cell) = change.after;
    }

  private:
    Settings settings_;
    std::uint32_t seed_, tick_ = 0;
    Cells cells_;
};

}  // namespace

std::unique_ptr<WaterStepper> make_gpu_stepper(const Scene& scene, const StepperOptions& options) {
    return std::make_unique<GpuStepper>(scene, options);
}

std::unique_ptr<WaterStepper> make_reference_stepper(const Scene& scene, const StepperOptions& options) {
    return std::make_unique<ReferenceStepper>(scene, options);
}

}  // namespace tarn
