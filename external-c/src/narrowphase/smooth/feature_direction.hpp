// The direction out of an overlap from what its rough witness points lie on.
#pragma once

#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/smooth/direction_refinement.hpp"

namespace cmb::convex {

// The vertex, edge, side or flat end that the points `a` and `b` (of the cores, each in its own frame) lie on tell which minimum of the
// support function is near the unit vector `direction`, and in which of its smooth parts: one run of Newton's method, or
// a closed form, gives it to rounding. False where it does not lead to one. Whether it is the least of all remains
// to be proven (interior_ball.hpp).
bool feature_direction(const MinkowskiDifference &difference, const Vec3 &direction, const Vec3 &a, const Vec3 &b,
                       RefinedDirection &result);

}  // namespace cmb::convex
