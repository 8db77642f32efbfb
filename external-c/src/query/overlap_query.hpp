// The overlap of a pair of bodies as a solid.
#pragma once

#include "contact_multibody.h"
#include "scene/scene.hpp"

namespace cmb {

// The overlap of bodies A and B, in world axes; see cmb_query_overlap. Allocates until this thread's
// scratch has grown.
cmb_overlap query_overlap(const BodyShapes &a, const Pose &pose_a, const BodyShapes &b, const Pose &pose_b);

}  // namespace cmb
