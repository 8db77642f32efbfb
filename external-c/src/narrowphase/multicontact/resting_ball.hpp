// A ball inside the difference C = A - B whose centre is the nearest to the origin, and the places that it rests on.
#pragma once

#include "narrowphase/convex_distance.hpp"
#include "narrowphase/multicontact/held_ball.hpp"

namespace cmb::convex {

// Brings a ball that has been settled to rest: no place of C's surface is nearer to its centre than the radius, to the slack,
// and the cuts are where it touches. False where no such ball fits. Bodies of `size` (m).
bool bring_to_rest(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, HeldBall &ball,
                   DistanceScratch &scratch);

}  // namespace cmb::convex
