// Minima of the Minkowski difference's support function just beside the circles and points where it is not smooth.
//
// Newton's method from elsewhere stumbles over a circle (a crease) or a point (a flat end, a face) that is nearer to the
// minimum than its start. From there, on the side to which the function falls, the minimum is a step away.
#pragma once

#include <algorithm>

#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/smooth/direction_newton.hpp"

namespace cmb::convex {

// The lowest direction so far, and what it lies on.
struct LowestDirection {
  Vec3 direction;
  double height;
  bool on_flat = false;                          // at a flat end,
  const Crease *crease[2] = {nullptr, nullptr};  // or on a crease, or where two meet

  // A candidate that is as low to `rounding` replaces one found by less exact means. Whether it is lower.
  bool attempt(const MinkowskiDifference &difference, const Vec3 &m, double rounding, bool flat = false,
               const Crease *first = nullptr, const Crease *second = nullptr) {
    const double there = dot(difference.support(m).w, m);
    if (there > height + rounding) return false;
    const bool lower = there < height - rounding;
    *this = {m, std::min(height, there), flat, {first, second}};
    return lower;
  }
};

// Goes on from a crease or a flat end to a lower minimum beside it, if there is one. What that lies on is not kept.
void descend_from_creases(const MinkowskiDifference &difference, double rounding, LowestDirection &lowest);

}  // namespace cmb::convex
