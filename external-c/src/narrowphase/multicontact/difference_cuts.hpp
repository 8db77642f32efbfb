// Supporting planes of the difference C = A - B where its surface is near a ball.
#pragma once

#include "narrowphase/convex_distance.hpp"
#include "narrowphase/multicontact/held_ball.hpp"

namespace cmb::convex {

// The supporting plane where the surface is nearest to `centre`, B moved by which the distance is.
Cut cut_at(const SignedDistance &there, const Vec3 &centre);

// The distance of bodies, B moved by the ball's centre, whose difference's surface is about equally near at the ball's cuts, and
// may be as near elsewhere.
SignedDistance distance_beside(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const HeldBall &ball,
                               DistanceScratch &scratch);

// Moves a cut to where the surface is the nearest to `from`, unless that is another place, as near.
void move_cut(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const Vec3 &from, Cut &cut);

}  // namespace cmb::convex
