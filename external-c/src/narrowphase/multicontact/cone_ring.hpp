// A ball that a corner of one body holds all about the axis of the other body's cone.
//
// Where a point alone of the other body is the farthest along a cone's side, the difference C = A - B is a cone itself
// there. A ball that has room in its tip no farther touches it all round, and stays there for all origins within the
// tip's normals: the ball tells its centre, but not which of the places all round hold it, and those that a search
// happens to meet change at once.
#pragma once

#include "narrowphase/multicontact/active_set.hpp"
#include "shape/convex_body.hpp"

namespace cmb::convex {

// Where a ball at rest is so held, its planes are made those that follow from the ring of places and the load alone, and
// change continuously with both: in the plane of axis and load the two places of the ring, or, where a direction is not
// the corner's, as an edge of the other body lies there, both ends of that gap in the ring instead. Bodies of `size` (m).
// False, and nothing changed, where the ball is held otherwise.
bool replace_by_cone_ring(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, ActiveSet &active);

}  // namespace cmb::convex
