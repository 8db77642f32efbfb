// The projection of the origin onto the inner parallel body of the difference C = A - B, as far as it is bounded by a few of C's
// supporting planes.
#pragma once

#include "math/vector3.hpp"

namespace cmb::convex {

// A supporting plane of the difference: direction . c <= height on it.
struct SupportingPlane {
  Vec3 direction;  // unit, outward
  double height = 0.0;
  Vec3 a, b;                // points of both surfaces on it, in A's frame
  double multiplier = 0.0;  // of its constraint in the projection, m
};

// The centre is the point p nearest to the origin with direction . p <= height - radius for all planes: minus the sum of
// multiplier * direction.
struct ActiveSet {
  double radius = 0.0, slack = 0.0;  // m
  Vec3 centre;
  static constexpr int most = 4;
  SupportingPlane planes[most];
  int count = 0;
  bool on_cone_ring = false;  // the planes are those that stand for places all about an axis (cone_ring.hpp)

  // Solves for the centre and the multipliers, of four planes at most, and drops inactive planes, so that three stay at most.
  // False, and nothing changed, where the constraints have no solution.
  bool project_origin();

  // The point where the planes direction . p = first, second and third of three planes meet. False where they do not.
  bool intersection(double first, double second, double third, Vec3 &p) const;
};

}  // namespace cmb::convex
