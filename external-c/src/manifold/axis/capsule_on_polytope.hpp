// Contact of a capsule with a box or hull: points that carry the force, the torque and the energy of its axis (axis_energy.hpp).
// The obstacle's side, edge or corner nearest to a place of the axis pushes it; inside the obstacle its nearest side does.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "narrowphase/polytope/nearest_features.hpp"
#include "shape/shape.hpp"

namespace cmb {

// A stretch of the axis and the feature nearest to it.
struct AxisPiece {
  convex::Feature feature;
  double from = 0.0, to = 0.0;
};

// Room that it works in; one for each thread.
struct CapsuleScratch {
  std::vector<AxisPiece> pieces;
  convex::FacesAlongLine faces;
};

// Appends two points that carry the part of the energy that is returned (carried_part.hpp).
// `depth` (m, > 0) is the length of the minimum translation, `deepest` the capsule's deepest place on its surface, `normal` the contact normal
// there, from the obstacle to the capsule, and `sense` 1 where the capsule is the first body of the pair, -1 where it is the second one.
double capsule_on_polytope(const Shape &capsule, const Pose &pose, const Shape &polytope, const Pose &polytope_pose, double depth,
                           const Vec3 &deepest, const Vec3 &normal, double sense, CapsuleScratch &scratch,
                           std::vector<ContactPoint> &points);

}  // namespace cmb
