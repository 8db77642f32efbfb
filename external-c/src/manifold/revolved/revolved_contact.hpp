// Contact of a cylinder or cone with a polytope, or with another one: points that carry the force, the torque and the energy of their overlap.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "manifold/polytope/depth_below_faces.hpp"
#include "manifold/revolved/revolved_on_polytope.hpp"
#include "manifold/revolved/revolved_pair.hpp"
#include "manifold/surface/flush_sides.hpp"
#include "shape/shape.hpp"

namespace cmb {

// Room for one contact.
struct RevolvedScratch {
  OverlapSurface surface;
  RevolvedOnPolytope on_polytope;
  RevolvedPair pair;
  DepthBelowFaces faces;
  FlushSides flush;
};

// Appends the points (load_points.hpp) by which the body of revolution is pushed, or the polytope where `sense` is -1. `witness`: a place
// in the overlap, in world axes. False where the bodies overlap by rounding alone.
bool revolved_on_polytope_contact(const Shape &revolved, const Pose &revolved_pose, const ContactPolytope &polytope,
                                  const Pose &polytope_pose, const Vec3 &witness, double sense, RevolvedScratch &scratch,
                                  std::vector<ContactPoint> &points);

struct PairLoad {
  double energy = 0.0;  // none where the bodies overlap by rounding alone
  double known = 0.0;   // the part of the points that is more than rounding: of two thin borders through each other their load may be none
};

// The same of two bodies of revolution, by the places of each that are deepest in the other.
PairLoad revolved_pair_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const Vec3 &deepest_a,
                               const Vec3 &deepest_b, RevolvedScratch &scratch, std::vector<ContactPoint> &points);

}  // namespace cmb
