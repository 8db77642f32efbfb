// A ball inside the difference C = A - B that some of C's supporting planes hold, its centre the nearest to the origin.
#pragma once

#include "math/vector3.hpp"

namespace cmb::convex {

// A supporting plane of the difference: direction . c <= height on it.
struct Cut {
  Vec3 direction;  // unit, outward
  double height = 0.0;
  Vec3 a, b;          // points of both surfaces on it, in A's frame
  double pull = 0.0;  // on the ball's centre
};

// The ball's centre is the point nearest to the origin with direction . p <= height - radius for all cuts: minus the sum of
// pull * direction.
struct HeldBall {
  double radius = 0.0, slack = 0.0;  // m
  Vec3 centre;
  static constexpr int most = 4;
  Cut cuts[most];
  int count = 0;
  bool all_round = false;  // the cuts are those that stand for places all about an axis (cone_ring.hpp)

  // Finds the centre and the pulls for the planes of the cuts as they are, at most four, and drops cuts without pull, so
  // that three stay at most. False, and nothing changed, where there is no centre.
  bool settle();

  // The point where the planes direction . p = first, second and third of three cuts meet. False where they do not.
  bool meeting_place(double first, double second, double third, Vec3 &p) const;
};

}  // namespace cmb::convex
