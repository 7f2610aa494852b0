#include "world/noise.h"

#include <cmath>
#include <utility>

#include "shared/hash.h"

namespace tarn {

namespace {

double fade(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

double mix(double a, double b, double t) {
    return a + t * (b - a);
}

// One of the 12 directions to the middle of a cube's edges (four of them twice), dotted with `offset`.
double gradient(std::uint8_t hash, glm::dvec3 offset) {
    const int h = hash & 15;
    const double u = h < 8 ? offset.x : offset.y;
    const double v = h < 4 ? offset.y : (h == 12 || h == 14 ? offset.x : offset.z);
    return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
}

}  // namespace

PerlinNoise::PerlinNoise(std::uint32_t seed) {
    for (int i = 0; i < 256; ++i) permutation_[i] = static_cast<std::uint8_t>(i);
    for (std::uint32_t i = 255; i > 0; --i)
        std::swap(permutation_[i], permutation_[hash2(seed, i) % (i + 1)]);
    for (int i = 0; i < 256; ++i) permutation_[256 + i] = permutation_[i];
}

double PerlinNoise::at(glm::dvec3 position) const {
    const glm::dvec3 cell = glm::floor(position);
    const glm::dvec3 f = position - cell;
    const auto wrap = [](double c) { return static_cast<int>(c - 256 * std::floor(c / 256)); };
    const int x = wrap(cell.x);
    const int y = wrap(cell.y);
    const int z = wrap(cell.z);
    const glm::dvec3 w(fade(f.x), fade(f.y), fade(f.z));
    const auto& p = permutation_;
    const auto corner = [&](int dx, int dy, int dz) {
        const std::uint8_t hash = p[p[p[(x + dx) & 255] + ((y + dy) & 255)] + ((z + dz) & 255)];
        return gradient(hash, f - glm::dvec3(dx, dy, dz));
    };
    const auto line = [&](int dy, int dz) { return mix(corner(0, dy, dz), corner(1, dy, dz), w.x); };
    return mix(mix(line(0, 0), line(1, 0), w.y), mix(line(0, 1), line(1, 1), w.y), w.z);
}

double PerlinNoise::fractal(glm::dvec3 position, int octaves, double persistence, double ridged) const {
    double sum = 0;
    double weights = 0;
    double weight = 1;
    double frequency = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        // Octaves are moved apart, else their zeros at whole coordinates fall together.
        const double n = at(position * frequency + glm::dvec3(17.31, 5.77, 41.93) * double(octave));
        sum += weight * mix(n, 1 - 2 * std::abs(n), ridged);
        weights += weight;
        weight *= persistence;
        frequency *= 2;
    }
    return sum / weights;
}

}  // namespace tarn
