// Multipliers of the projection of the origin onto an inner parallel body, where active planes alone do not determine them
// continuously.
#pragma once

#include "narrowphase/multicontact/cutting_plane_projection.hpp"
#include "narrowphase/multicontact/near_active_faces.hpp"

namespace cmb::convex {

// The multipliers of a solved active set, divided among its two or three planes and those that are nearly active.
//
// Where four planes are active any three may do without the fourth, and which of them stay depends on where the origin moves:
// multipliers of three alone jump. Those here are the forces of unilateral springs at the planes under the load -p: the softer
// the farther a plane is from the ball, and the stiffer the more nearly it opposes the load, so that a plane that is about to be
// the only active one takes all. Planes that the ball does not touch are
// - where the active ones are faces of boxes and polytopes alone, all other faces within a twentieth of the radius: the ball in the tip
//   of a regular pyramid touches all of its faces, whatever its size;
// - beside three active planes, up to two that it would touch if it grew or shrank a little on these (its centre moves by a
//   twentieth of the radius, less where one of the three is about to leave).
constexpr int max_planes = 5 + NearActiveFaces::most;
// Returns how many planes `places` receives.
int distribute_multipliers(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, const ActiveSet &active,
                           DistanceScratch &scratch, SupportingPlane places[max_planes]);

}  // namespace cmb::convex
