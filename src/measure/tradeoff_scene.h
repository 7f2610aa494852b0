// One scene of the trade: what a configuration costs there, and how far its pictures are from references over
// recordings. Owns the scene's world and its references; chooses nothing.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/renderer.h"
#include "app/simulation.h"
#include "measure/references.h"
#include "measure/tradeoff_space.h"
#include "world/recording.h"
#include "world/scene.h"

namespace tarn {

struct TradeoffOptions {
    glm::ivec2 error_px{160, 90};
    glm::ivec2 time_px{640, 360};
    int frame_stride = 1;          // every so many frames of a recording are compared
    int rounds = 5;                // of time
    std::filesystem::path folder;  // of the references; empty: none are kept
};

struct PictureError {
    double error = 0, bias = 0, floor = 0;  // relMSE, means over the frames
    double predicted = -1;                  // Renderer::estimated_error() likewise; -1: none
    int reference_samples = 0;              // of both halves
    std::uint64_t rejected = 0;
};

class TradeoffScene {
  public:
    // `ticks` run before everything. Needs a current context. Throws Error for a name that is none.
    TradeoffScene(const std::string& name, std::uint64_t ticks, const TradeoffOptions& options);

    const std::string& name() const { return scene_.name; }
    // Samples the recording's references until each half has `samples` a pixel. `progress`: samples so far.
    void sample_references(const Recording& recording, int samples, const std::function<void(int)>& progress);
    const References& references(const Recording& recording) { return *references_of(recording).references; }

    // Two independent runs of the recording.
    PictureError measure_error(const Recording& recording, const Configuration& configuration);

    // Of the exact mean of so many samples a pixel of the recording's first frame, for each of `samples`,
    // which grow.
    std::vector<PictureError> measure_exact(const Recording& recording, std::span<const int> samples);

    // Milliseconds of a frame in flight: medians over rounds in which each takes its turn.
    std::vector<double> measure_times(std::span<const Configuration> configurations);

  private:
    struct OfRecording {
        Recording recording;
        std::vector<int> frames;  // compared
        std::unique_ptr<References> references;
    };
    OfRecording& references_of(const Recording& recording);
    Settings settings_of(const Configuration& configuration) const;
    void rest();  // the world as the scene says
    // Lead frames, then those up to the last that is compared; calls draw() for each, compare(index in
    // frames) after those that are.
    void play(const OfRecording& of, Settings& settings, bool lead, const std::function<void()>& draw,
              const std::function<void(int)>& compare);
    Luminance shown() const { return luminance_of(renderer_->read_radiance()); }
    void draw(const Settings& settings, glm::ivec2 size_px);

    TradeoffOptions options_;
    Scene scene_;  // its cells after the ticks
    gl::Timers timers_;
    std::unique_ptr<Simulation> simulation_;
    bool world_at_rest_ = true;  // the simulation is as the scene says
    std::unique_ptr<Renderer> renderer_;
    std::map<std::string, OfRecording> recordings_;
};

}  // namespace tarn
