// The bar for ghosts: after a change, the error of what changed is soon within 1.5 times of what it is in the
// long run, which is that of a picture begun anew.
#include <memory>
#include <numeric>
#include <vector>

#include "studio.h"

namespace tarn {
namespace {

// Errors are means over takes of the same frames that differ in their random numbers: of one take, of a few
// hundred pixels, chance decides.
class GhostsTest : public GlTest {
  protected:
    // In much smaller pictures the block's shadow is a few pixels wide, fewer than retracing resolves, and
    // lags.
    static constexpr glm::ivec2 size{240, 135};
    static constexpr int frames_of_steady = 50, frames_of_mean = 10;  // the last of them
    static constexpr int frames_allowed = 10;
    static constexpr int frames_within = 3;  // their mean is, too: of one, chance decides
    static constexpr int takes_of_a_frame = 2;

    Studio studio{balanced("waterfall")};
    using Takes = std::vector<std::unique_ptr<Renderer>>;
    Takes takes, anew;

    GhostsTest() {
        for (int i = 0; i < takes_of_a_frame; ++i)
            for (Takes* some : {&takes, &anew}) {
                some->push_back(std::make_unique<Renderer>(studio.scene, studio.timers));
                some->back()->set_frame_index(std::uint64_t{1024} * i);
            }
    }
    void shoot(const Takes& some) {
        for (const auto& take : some) take->render(studio.simulation, studio.settings(), size);
    }
    // Of the next frames.
    std::vector<double> errors_of(const Takes& some, const Picture& expected,
                                  const std::vector<char>& changed) {
        std::vector<double> errors(frames_of_steady, 0);
        for (double& error : errors) {
            shoot(some);
            for (const auto& take : some)
                error += relative_error({take->read_radiance(), 0}, expected, changed) / takes_of_a_frame;
        }
        return errors;
    }
    static double mean_of(std::vector<double>::const_iterator first, int count) {
        return std::accumulate(first, first + count, 0.0) / count;
    }

    static Scene balanced(const char* name) {
        Settings settings;
        apply_quality(settings, Quality::Balanced);
        settings.refine_at_rest = false;
        return load_scene(name, settings);
    }
    Picture truth() {
        Settings exact = studio.settings();
        apply_quality(exact, Quality::Exact);
        // As the preset draws them: what differs for good says nothing of ghosts.
        exact.caustics = false;
        exact.smooth_water = exact.straight_sunlight = true;
        exact.firefly_limit = studio.settings().firefly_limit;
        Renderer reference(studio.scene, studio.timers);
        for (int frame = 0; frame < 100; ++frame) reference.render(studio.simulation, exact, size);
        return {reference.read_radiance(), 0};
    }
    // Pixels of which a channel differs by more than a tenth and more than their noise.
    static std::vector<char> differing(const Picture& a, const Picture& b) {
        std::vector<char> differs(a.image.pixels.size() / 3, 0);
        for (std::size_t i = 0; i < a.image.pixels.size(); ++i) {
            const float larger = std::max(a.image.pixels[i], b.image.pixels[i]);
            if (std::abs(a.image.pixels[i] - b.image.pixels[i]) > 0.1f * larger + 0.05f) differs[i / 3] = 1;
        }
        return differs;
    }
    void expect_no_ghost_of(const char* what, const Picture& before) {
        const Picture expected = truth();
        const std::vector<char> changed = differing(before, expected);
        const auto pixels = std::ranges::count(changed, 1);
        ASSERT_GT(pixels, 40) << what;
        const double ghost = relative_error(before, expected, changed);
        const std::vector<double> errors = errors_of(takes, expected, changed);
        for (const auto& take : anew) take->reset_history();
        const std::vector<double> errors_anew = errors_of(anew, expected, changed);
        const double steady = mean_of(errors.end() - frames_of_mean, frames_of_mean);
        const double steady_anew = mean_of(errors_anew.end() - frames_of_mean, frames_of_mean);
        const double bar = 1.5 * steady;
        auto frame = errors.begin();
        while (frame + frames_within < errors.end() && (*frame > bar || mean_of(frame, frames_within) > bar))
            ++frame;
        const auto frames = frame - errors.begin() + 1;
        fmt::print(
            "{}: of {} pixels that changed, error {:.3f} as before, {:.3f} in the first frame, {:.3f} in the "
            "long run ({:.3f} begun anew), within 1.5 times from frame {}\n",
            what, pixels, ghost, errors.front(), steady, steady_anew, frames);
        EXPECT_LE(frames, frames_allowed) << what;
        // Else a ghost that fades slowly would be part of its own bar.
        EXPECT_LT(steady, 1.3 * steady_anew) << what;
        // Else a ghost that stays would pass.
        EXPECT_GT(ghost, 3 * steady) << what;
    }
};

TEST_F(GhostsTest, AreGoneSoonAfterAStopAnEditAndAJump) {
    const auto flow = [&](int frames) {
        for (int frame = 0; frame < frames; ++frame) {
            studio.simulation.step(1, studio.settings());
            shoot(takes);
        }
    };
    studio.simulation.step(40, studio.settings());
    flow(17);
    Picture before = truth();
    flow(3);
    expect_no_ghost_of("a waterfall that stops", before);
    before = truth();
    put(studio, {48, 30, 60}, 4, MATERIAL_STONE);
    expect_no_ghost_of("a block put up", before);
    before = truth();
    put(studio, {48, 30, 60}, 4, MATERIAL_AIR);
    expect_no_ghost_of("a block taken away", before);
    before = truth();
    studio.settings().camera_position_vox += glm::vec3(20, 5, -15);
    studio.settings().camera_yaw_deg -= 25;
    expect_no_ghost_of("a jump of the eye", before);
}

}  // namespace
}  // namespace tarn
