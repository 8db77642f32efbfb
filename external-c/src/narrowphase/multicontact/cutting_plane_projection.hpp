// A ball inside the difference C = A - B whose centre is the nearest to the origin, and the places that it rests on.
#pragma once

#include "narrowphase/convex_distance.hpp"
#include "narrowphase/multicontact/active_set.hpp"

namespace cmb::convex {

// Brings a ball that has been projected to the solution: no place of C's surface is nearer to its centre than the radius, to
// the slack,
// and the planes are where it touches. False where no such ball fits. Bodies of `size` (m).
bool cutting_plane_projection(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, ActiveSet &active,
                              DistanceScratch &scratch);

}  // namespace cmb::convex
