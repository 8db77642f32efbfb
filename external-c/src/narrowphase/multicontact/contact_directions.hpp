// The contact directions of an overlap: where a ball inside the difference C = A - B touches its surface.
//
// The minimum translation of C jumps where two places of its surface become equally near. Take instead the ball inside C of a
// given radius, a little greater than the depth, whose centre is the nearest to the origin. The centres of all such balls
// form a convex set (C worn off by the radius), and the nearest point of a convex set moves continuously with it. Where
// one place alone is near, the ball touches there, and the way is the shortest one, exactly. Else the ball rests
// on up to three places, in passing or in a regular tip on more, and the pull of the origin on its centre divides among them
// as among the supports of a load.
#pragma once

#include "narrowphase/convex_distance.hpp"

namespace cmb::convex {

struct ContactDirection {
  Vec3 normal;            // unit, from B to A, in A's frame
  double depth = 0.0;     // m: how far B reaches beyond A's support along it
  Vec3 point_a, point_b;  // of both surfaces, in A's frame
  Vec3 aside;             // perpendicular to the normal: B moved by it, the points face each other
  double share = 1.0;     // >= 0; the sum of share * normal over all ways is a unit vector, their own sum at most 8: where
                          // ways nearly oppose each other, as of a thin plate, the shortest takes over
};

struct ContactDirections {
  static constexpr int most = 24;
  ContactDirection contact[most];
  int count = 0;
};

// The contact directions of an overlap whose shortest way is `nearest` (distance < 0), for bodies of `size`. Where the
// bodies are
// so deep in each other that no such ball fits, the shortest alone.
ContactDirections contact_directions(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a,
                                     const SignedDistance &nearest, double size,
                                     DistanceScratch &scratch);

}  // namespace cmb::convex
