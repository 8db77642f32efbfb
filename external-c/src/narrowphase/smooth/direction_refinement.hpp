// Sharpens the direction in which the Minkowski difference's support function is least.
#pragma once

#include "narrowphase/minkowski_difference.hpp"

namespace cmb::convex {

struct RefinedDirection {
  Vec3 direction;  // unit, from A to B
  double height;   // the support function along it: minus the signed distance of the cores
  Vec3 a, b;       // witness points
};

constexpr double near_creases = 3e-3;  // rad

// Starts from `direction` (unit) and witness points near the answer. The support function is smooth but
// for circles on the sphere of directions (a box's edges, a cylinder's side, a cone's side) and single
// points (a flat end): the minimum is sought by Newton's method on the sphere, along each such circle
// nearby, and where two of them meet, and the lowest taken. The height never exceeds that of the start
// by more than rounding. `nearby` (radians) says how far away circles and points are looked for,
// `from_afar` whether their lowest places may lie farther along them. Keeps
// no state.
RefinedDirection refine_direction(const MinkowskiDifference &difference, const Vec3 &direction, const Vec3 &a,
                                  const Vec3 &b, double nearby = near_creases, bool from_afar = false);

// Whether circles or points are nearer than `nearby` (radians) to a minimum `direction` (unit) that it is not on: another minimum
// there may be lower.
bool creases_nearby(const MinkowskiDifference &difference, const Vec3 &direction, double nearby = near_creases);

}  // namespace cmb::convex
