// The contact directions of an overlap: the active supporting planes in the projection of the origin onto an inner parallel body of
// the Minkowski difference C = A - B.
//
// The minimum translation jumps where two places of C's surface become equally near; the projection onto the convex set of the
// centres of all balls of a given radius in C does not. Derivation: docs/engine/concept.md, "Contact directions of other curved
// bodies".
#pragma once

#include <cmath>

#include "narrowphase/convex_distance.hpp"

namespace cmb::convex {

// The radius of those balls where the bodies, of `size`, are `depth` deep in each other: 1.5 depths where that is shallow; deeper,
// what of the surface counts stops growing.
inline double inner_parallel_radius(double depth, double size) {
  constexpr double sideways = 1.25;  // 1.5^2 - 1
  constexpr double deep = 0.05;
  const double part = depth / (deep * size);
  return depth * std::sqrt(1.0 + sideways / (1.0 + part * part));
}

struct ContactDirection {
  Vec3 normal;            // unit, from B to A, in A's frame
  double depth = 0.0;     // m: how far B reaches beyond A's support along it
  Vec3 point_a, point_b;  // of both surfaces, in A's frame
  Vec3 aside;             // perpendicular to the normal: B moved by it, the points face each other
  double share = 1.0;     // >= 0, the normalised multiplier; the sum of share * normal is a unit vector, that of the shares at most
                          // 8: where directions nearly oppose each other, as of a thin plate, the shortest takes over
};

struct ContactDirections {
  static constexpr int most = 24;
  ContactDirection contact[most];
  int count = 0;
};

// The contact directions of an overlap whose minimum translation is `nearest` (distance < 0), for bodies of `size`. Where the
// bodies are so deep in each other that no such ball fits, the shortest alone.
ContactDirections contact_directions(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a,
                                     const SignedDistance &nearest, double size,
                                     DistanceScratch &scratch);

}  // namespace cmb::convex
