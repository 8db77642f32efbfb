// Supporting planes of the difference C = A - B where its surface is near a ball.
#pragma once

#include "narrowphase/convex_distance.hpp"
#include "narrowphase/multicontact/active_set.hpp"

namespace cmb::convex {

// The supporting plane where the surface is nearest to `centre`, B moved by which the distance is.
SupportingPlane supporting_plane_at(const SignedDistance &there, const Vec3 &centre);

// The distance of bodies, B moved by the ball's centre, whose difference's surface is about equally near at the ball's
// planes, and may be as near elsewhere.
SignedDistance distance_from_centre(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const ActiveSet &active,
                                    DistanceScratch &scratch);

// Moves a plane to where the surface is the nearest to `from`, unless that is another place, as near.
void update_plane(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const Vec3 &from, SupportingPlane &plane);

}  // namespace cmb::convex
