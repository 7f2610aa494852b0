// Rays that every contestant of the suite `rays` is given: made once, on the CPU, from a scene's camera.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/settings.h"
#include "world/cells.h"

namespace tarn {

struct BenchRay {
    glm::vec4 origin_vox, dir;  // w unused
    glm::ivec4 cell;            // w: medium around the origin. Of rays from the eye neither is known
};

struct RaySet {
    std::string name;       // primary, diffuse, in-water, shadow
    bool from_eye = false;  // all of one origin
    bool any_hit = false;   // only whether something is hit is asked for
    std::vector<BenchRay> rays;
};

// Pinhole rays of a picture; cosine directions from the solid faces that they hit; rays to the sun from those
// of these faces that see it rise; rays refracted into the water that they hit. Kinds without a ray are left
// out. Neighbours stay neighbours: eight rays in a row belong to 4x2 pixels of the picture, as far as they
// hit.
std::vector<RaySet> make_ray_sets(const Cells& cells, const Settings& settings, glm::ivec2 size_px);

// Of make_ray_sets only the first.
RaySet make_primary_rays(const Settings& settings, glm::ivec2 size_px);

}  // namespace tarn
