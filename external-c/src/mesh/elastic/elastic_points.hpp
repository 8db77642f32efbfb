// Contact points whose forces are an energy's gradient.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "mesh/elastic/direction_patches.hpp"
#include "mesh/elastic/wedge_energy.hpp"
#include "mesh/elastic/wedge_integrals.hpp"

namespace cmb::mesh {

// Room for one contact; grows in the first calls.
struct ElasticScratch {
  WedgeEnergyScratch energy;
  std::vector<LoadPoint> points;
};

// Appends points that carry the energy's wrench exactly and store it, in world axes, and sets distance, normal and
// witness. `points` is overwritten.
//
// Loads begin as those of the patches. Their forces are scaled, and each gets the same part of its load in addition, until they sum
// to the overlap's force. What torque is lacking comes from a shift of the points along the surface, as at the edge of a tilted face,
// whose force acts at its border; what turns about the force itself from normals that tilt about it. Points of hardly any load stay where
// they are.
//
// `stored`: of `overlap`. Where its force would pull, it is bounded by the patches' load.
//
// Returns the load of the patches, about their mean depth by area.
double append_elastic_points(const WedgeIntegrals &overlap, const WedgeEnergy &stored, const Pose &pose, std::vector<LoadPoint> &points,
                             ContactSet &result);

}  // namespace cmb::mesh
