// Signed distance of two convex cores of which one at least is an ellipsoid, cylinder or cone.
#pragma once

#include "closed_distance.hpp"

namespace cmb::convex {

// `first` is a direction from B to A (not zero) to begin with. Where several places of the difference's surface are known to
// be equally near (`several_near`), none of the proofs for one alone is tried.
CoreDistance curved_distance(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &b_in_a, const Vec3 &first,
                             DistanceScratch &scratch, bool several_near = false);

}  // namespace cmb::convex
