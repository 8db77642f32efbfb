// Contact points whose forces are an energy's gradient.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "mesh/elastic/direction_patches.hpp"
#include "mesh/elastic/wedge_integrals.hpp"

namespace cmb::mesh {

// Appends points that carry the overlap's wrench exactly and store its energy, in world axes, and sets distance, normal and
// witness. `points` is overwritten.
//
// Loads begin as those of the patches. Their forces are scaled, and each gets the same part of its load in addition, until they sum
// to the overlap's force. What torque is lacking comes from a shift of the points along the surface, as at the edge of a tilted face,
// whose force acts at its border; what turns about the force itself from normals that tilt about it. Points of hardly any load stay where
// they are.
//
// Where the overlap's force would pull, or depths are rounding, it is bounded by the patches' load.
//
// Returns the load of the patches, their mean depth.
double append_elastic_points(const WedgeIntegrals &overlap, const Pose &pose, std::vector<LoadPoint> &points, ContactSet &result);

}  // namespace cmb::mesh
