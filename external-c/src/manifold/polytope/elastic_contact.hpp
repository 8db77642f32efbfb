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

// Appends four points of equal depth, so that a law of another exponent than 1 keeps their shares of the load: all forces together
// are scaled. They spread along the surface as the corners of a rectangle that is as wide, a box's face that lies on another at its
// corners; their weights and normals follow from what torque the load has about them.
// `normal` (unit, from B to A): the direction across the overlap, `witness` a place in it, both in world axes. False where the
// bodies overlap by rounding alone.
bool elastic_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                     const Vec3 &normal, const Vec3 &witness, ElasticScratch &scratch, std::vector<ContactPoint> &points);

}  // namespace cmb
