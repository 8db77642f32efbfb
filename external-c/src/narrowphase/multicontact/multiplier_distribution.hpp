// How the pull of the origin on a ball inside the difference C = A - B divides among the places that it touches and nearly
// touches.
#pragma once

#include "narrowphase/multicontact/cutting_plane_projection.hpp"
#include "narrowphase/multicontact/near_active_faces.hpp"

namespace cmb::convex {

// The pulls on a ball at rest, divided among the two or three places that it rests on and those that it nearly touches.
//
// Of four places that hold a ball at once any three may do without the fourth, and which of them are left once it has
// moved on depends on where to: pulls by three places alone jump. Those here are what springs at the places would take, the
// softer the farther a place is from the ball, and the stiffer the more nearly it is opposite the pull, so that a place that is
// about to hold the ball alone takes all. Places that the ball does not touch are
// - where it rests on faces of boxes and polytopes alone, all other faces within a twentieth of the radius: the ball in the tip
//   of a regular pyramid touches all of its faces, whatever its size;
// - beside three places, up to two that it would touch if it grew or shrank a little on these (its centre moves by a
//   twentieth of the radius, less where one of the three is about to leave).
constexpr int max_planes = 5 + NearActiveFaces::most;
// Returns how many `places` receive.
int distribute_multipliers(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, const ActiveSet &active,
                           DistanceScratch &scratch, SupportingPlane places[max_planes]);

}  // namespace cmb::convex
