// Improved Perlin noise (Perlin, "Improving Noise", SIGGRAPH 2002) over a permutation shuffled by a seed.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace tarn {

class PerlinNoise {
  public:
    explicit PerlinNoise(std::uint32_t seed);

    // In [-1, 1], 0 at whole coordinates; period 256 along each axis. The same on every machine.
    double at(glm::dvec3 position) const;

    // Sum of `octaves` octaves, each of half the wavelength and `persistence` times the height of the one
    // before; in [-1, 1]. `ridged` in [0, 1] blends rolling ground into sharp crests.
    double fractal(glm::dvec3 position, int octaves, double persistence, double ridged) const;

  private:
    std::array<std::uint8_t, 512> permutation_{};  // twice the same 256, so that sums need no wrap
};

}  // namespace tarn
