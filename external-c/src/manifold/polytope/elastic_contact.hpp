// Contact of two polytopes: points that carry the force, the torque and the energy of their overlap.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "manifold/polytope/overlap_energy.hpp"
#include "manifold/polytope/overlap_solid.hpp"

namespace cmb {

// Room for one contact.
struct ElasticScratch {
  OverlapSolid solid;
  OverlapEnergy energy;
};

// Appends the points of what the overlap does (load_points.hpp).
// `normal` (unit, from B to A): the direction across the overlap, `witness` a place in it, both in world axes. False where the
// bodies overlap by rounding alone.
bool elastic_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                     const Vec3 &normal, const Vec3 &witness, ElasticScratch &scratch, std::vector<ContactPoint> &points);

}  // namespace cmb
