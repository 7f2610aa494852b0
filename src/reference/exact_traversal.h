// The walk of rays in exact arithmetic: what a ray given by float32 numbers meets if nothing is rounded. It
// counts where the float32 walk is mistaken; it is not for pictures.
#pragma once
#include "reference/traversal.h"

namespace tarn::reference {

// As trace_ray without a limit, every comparison exact; ties still go x < y < z. `t` of the result is
// rounded. Directions and origins are finite; components of a direction below traversal_still are taken at
// their value.
RayHit trace_ray_exact(const Cells& cells, const RayStart& start, glm::vec3 dir);

}  // namespace tarn::reference
