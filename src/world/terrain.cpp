#include "world/terrain.h"

#include <algorithm>
#include <cmath>

#include "shared/hash.h"
#include "world/noise.h"

namespace tarn {

namespace {

// A number for every column of a world, x fastest.
template <typename T>
struct Columns {
    glm::ivec2 size;
    std::vector<T> values;
    explicit Columns(glm::ivec2 size_vox)
        : size(size_vox), values(std::size_t{1} * size_vox.x * size_vox.y) {}
    T& at(int x, int z) { return values[x + std::size_t{1} * size.x * z]; }
    T at(int x, int z) const { return values[x + std::size_t{1} * size.x * z]; }
    bool contains(int x, int z) const { return x >= 0 && z >= 0 && x < size.x && z < size.y; }
};

// Noise layers lie in planes of one 3D field, far enough apart to be unrelated and off its whole coordinates.
enum Layer { GROUND, WARP_X, WARP_Z, BEACH, PATCHES, BARE };

glm::dvec3 in_layer(Layer layer, double x, double z) {
    return {x, 0.37 + 19.0 * int{layer}, z};
}

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / std::max(to - from, 1e-9), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double ground_height(const Terrain& terrain, const PerlinNoise& noise, double x, double z) {
    const double scale = 1 / terrain.wavelength_vox;
    const double u =
        x + terrain.warp_vox * noise.fractal(in_layer(WARP_X, x * scale * 2, z * scale * 2), 3, 0.5, 0);
    const double v =
        z + terrain.warp_vox * noise.fractal(in_layer(WARP_Z, x * scale * 2, z * scale * 2), 3, 0.5, 0);
    double height =
        terrain.base_height_vox +
        terrain.amplitude_vox * noise.fractal(in_layer(GROUND, u * scale, v * scale), terrain.octaves,
                                              terrain.persistence, terrain.ridged);
    for (const TerrainShape& shape : terrain.shapes) {
        const glm::dvec2 offset = (glm::dvec2(u, v) - shape.center_vox) / shape.radius_vox;
        const double distance = std::sqrt(offset.x * offset.x + offset.y * offset.y);
        const double pull = shape.weight * (1 - smooth_step(shape.core, 1, distance));
        height += pull * (shape.height_vox - height);
    }
    return height;
}

// Lowers beach columns until none stands more than a voxel over one of its 8 neighbours: two sweeps a round,
// as in a distance transform, until nothing changes.
void relax_beach(Columns<int>& heights, const Columns<double>& beach_tops) {
    const auto lower = [&](int x, int z) {
        if (heights.at(x, z) > beach_tops.at(x, z)) return false;
        int lowest = heights.at(x, z);
        for (int dz = -1; dz <= 1; ++dz) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (heights.contains(x + dx, z + dz))
                    lowest = std::min(lowest, heights.at(x + dx, z + dz) + 1);
            }
        }
        const bool lowered = lowest < heights.at(x, z);
        heights.at(x, z) = lowest;
        return lowered;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (int z = 0; z < heights.size.y; ++z) {
            for (int x = 0; x < heights.size.x; ++x) changed |= lower(x, z);
        }
        for (int z = heights.size.y - 1; z >= 0; --z) {
            for (int x = heights.size.x - 1; x >= 0; --x) changed |= lower(x, z);
        }
    }
}

int steepest_step(const Columns<int>& heights, int x, int z) {
    int step = 0;
    for (const glm::ivec2 d : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
        if (heights.contains(x + d.x, z + d.y))
            step = std::max(step, std::abs(heights.at(x, z) - heights.at(x + d.x, z + d.y)));
    }
    return step;
}

bool is_bare(const Terrain& terrain, const PerlinNoise& noise, int x, int z, int height) {
    if (!terrain.bare_height_vox) return false;
    return height > *terrain.bare_height_vox + 3 * noise.at(in_layer(BARE, x / 9.0, z / 9.0));
}

}  // namespace

void build_terrain(const Terrain& terrain, std::uint32_t seed, Cells& cells) {
    const glm::ivec3 size = cells.size_vox();
    const PerlinNoise noise(hash2(seed, static_cast<std::uint32_t>(terrain.salt)));
    Columns<int> heights(glm::ivec2(size.x, size.z));
    Columns<double> beach_tops(heights.size);
    for (int z = 0; z < size.z; ++z) {
        for (int x = 0; x < size.x; ++x) {
            const double height = ground_height(terrain, noise, x + 0.5, z + 0.5);
            heights.at(x, z) = static_cast<int>(std::clamp(std::round(height), 1.0, double(size.y)));
            beach_tops.at(x, z) =
                terrain.beach ? terrain.beach->height_vox +
                                    terrain.beach->wobble_vox * noise.at(in_layer(BEACH, x / 11.0, z / 11.0))
                              : 0;
        }
    }
    if (terrain.beach) relax_beach(heights, beach_tops);
    for (int z = 0; z < size.z; ++z) {
        for (int x = 0; x < size.x; ++x) {
            const int height = heights.at(x, z);
            std::uint8_t top = terrain.top;
            std::uint8_t under = terrain.under;
            int under_depth = 1 + terrain.under_depth_vox;
            if (terrain.beach && height <= beach_tops.at(x, z)) {
                top = under = terrain.beach->material;
                under_depth = terrain.beach->depth_vox;
            } else if (steepest_step(heights, x, z) >= terrain.rock_slope ||
                       is_bare(terrain, noise, x, z, height)) {
                top = under = terrain.rock;
            } else if (terrain.patches) {
                const double scale = 1 / terrain.patches->wavelength_vox;
                const double n = noise.fractal(in_layer(PATCHES, x * scale, z * scale), 2, 0.5, 0);
                if (0.5 + 0.5 * n > 1 - terrain.patches->cover) top = terrain.patches->material;
            }
            for (int y = 0; y < height; ++y) {
                const int depth = height - 1 - y;
                cells.at({x, y, z}) = depth == 0 ? top : depth < under_depth ? under : terrain.rock;
            }
        }
    }
}

}  // namespace tarn
