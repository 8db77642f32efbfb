// The direction in which two overlapping polytopes push each other.
#pragma once

#include "manifold/polytope_side.hpp"

namespace cmb {

// The farthest parts of the difference's surface that have a say in the contact normal, in least depths.
constexpr double normal_reach = 2.0;

struct ContactNormal {
  Vec3 up;             // unit, from B to A, in the contact's axes
  double part_of_a = 0.0;  // how far it moves with A (1) or with B (0): with A where it is the normal of a face of A
};

// Let C = A - B be the Minkowski difference: the origin lies inside, and the shortest way out ends at the nearest place of
// C's surface, `least` away. It jumps where two places become equally near. The contact normal is instead the mean of
// the surface's normals, over all of the surface nearer than normal_reach * least, each place with the weight
// (1 - (distance / (normal_reach * least))^2)^2. A convex surface and its normals' mean over a ball change continuously
// with the bodies, and so does the contact normal. Where a face rests on a face, well inside its border, it is exactly
// the face's normal.
//
// `a` (sense -1) and `b` (sense +1) are gathered at least (1 + normal_reach) * least deep in contact axes whose z is the
// shortest way out; their origin is anywhere.
ContactNormal mean_contact_normal(const PolytopeSide &a, const PolytopeSide &b, double least);

}  // namespace cmb
