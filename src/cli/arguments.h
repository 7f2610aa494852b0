// Arguments of the subcommands, checked; knows no GL.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/settings.h"
#include "world/scene.h"

namespace tarn {

struct Arguments {
    std::string command;
    std::string scene = "lake";
    glm::ivec2 size_px{0};  // 0: chosen by the command
    std::string out, stats, cells, amounts, camera;
    std::optional<std::string> quality, view;
    std::vector<std::string> set;
    std::uint64_t ticks = 0;
    int frames = 1;
    std::string path;    // of `render`: a recording
    bool strip = false;  // its frames in one picture
    bool exact = false;
    int spp = 64;
    std::optional<std::uint32_t> seed;
    // Of `water` and `light`: comma-separated names; empty means all of them.
    std::string tiers, scenarios;
    int rounds = 12, spp_of_round = 8;  // of `light`
    int seeds = 1;
    std::vector<int> sides_vox{64, 128, 256};  // of --speed
    bool reference = false, awake = false, speed = false;
    // Of `bench`: suites separated by commas; files to compare.
    std::string suites, compare, with;
    std::vector<int> bench_sides_vox{128, 256, 512};
    int repeats = 5;
    // Of `tradeoff`; its scenes are `scenarios`.
    bool quick = false, resume = false, report = false;
    std::string write_front;
    int configurations = 0, reference_samples = 0;  // 0: by --quick
};

// Nothing where help was asked for and printed. Throws Error naming the argument, the reason and what is
// allowed.
std::optional<Arguments> parse_arguments(int argc, char** argv);

// The scene that the arguments name, with their settings: preset, scene, --set, --camera, --view, in this
// order.
Scene scene_of(const Arguments& arguments);

}  // namespace tarn
