// Embree on the exposed faces of a world: what Tarn's rays are measured against. Only where CMake found
// Embree 3 (TARN_EMBREE); nothing else of Tarn uses it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "bench/ray_sets.h"
#include "world/cells.h"

namespace tarn {

// "Embree 3.13.5", or "" where this program was built without it.
std::string embree_version();

// Rays as Embree's packets hold them: one array a component.
class EmbreeRays {
  public:
    explicit EmbreeRays(const RaySet& set);

    bool any_hit;
    bool coherent;  // of one origin or one direction
    float near_vox;
    std::size_t count;  // the arrays are longer, to whole packets
    std::vector<float> origin[3], dir[3];
};

class EmbreeScene {
  public:
    // Faces between air, water and solids, the world's outer ones too. Throws Error where embree_version() is
    // "".
    EmbreeScene(const Cells& cells, int threads);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    std::size_t quads() const;
    double mesh_ms() const;   // finding the faces, on one thread
    double build_ms() const;  // Embree's own

    // Distances of all rays, -1 where nothing is met; of any_hit rays 0 where something is. `packets`: eight
    // rays at once. Milliseconds by wall clock.
    double trace(const EmbreeRays& rays, bool packets, std::vector<float>& distance_vox) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tarn
