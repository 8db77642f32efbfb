// Projection of the origin onto an inner parallel body of the difference C = A - B by cutting planes.
#pragma once

#include "narrowphase/convex_distance.hpp"
#include "narrowphase/multicontact/active_set.hpp"

namespace cmb::convex {

// Adds supporting planes to an active set that has been solved, and moves them on curved surfaces, until the ball of its radius
// about its centre fits in C to the slack; the planes are then where it touches. False where no such ball fits. Bodies of
// `size` (m).
bool cutting_plane_projection(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, ActiveSet &active,
                              DistanceScratch &scratch);

}  // namespace cmb::convex
