// Distances of segments in long double.
#pragma once

#include <cmath>

#include "math/vector3.hpp"

namespace cmb::test {

// The least distance of the segments from -half_a to half_a and from t - half_b to t + half_b, by narrowing the stretch of the
// first where it may be, a convex function of the place, in long double.
inline double least_distance(const convex::Vec3 &half_a, const convex::Vec3 &half_b, const convex::Vec3 &t) {
  const long double a[3] = {half_a.x, half_a.y, half_a.z}, b[3] = {half_b.x, half_b.y, half_b.z}, to[3] = {t.x, t.y, t.z};
  const long double length2 = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
  const auto at = [&](long double s) {
    const long double from[3] = {s * a[0] - to[0], s * a[1] - to[1], s * a[2] - to[2]};
    const long double foot = (from[0] * b[0] + from[1] * b[1] + from[2] * b[2]) / length2;
    const long double r = std::fmin(1.0L, std::fmax(-1.0L, foot));
    const long double x = from[0] - r * b[0], y = from[1] - r * b[1], z = from[2] - r * b[2];
    return std::sqrt(x * x + y * y + z * z);
  };
  long double low = -1.0, high = 1.0;
  for (int step = 0; step < 120; ++step) {
    const long double one = low + (high - low) / 3.0L, two = high - (high - low) / 3.0L;
    if (at(one) < at(two)) {
      high = two;
    } else {
      low = one;
    }
  }
  return static_cast<double>(std::fmin(at(low), std::fmin(at(-1.0L), at(1.0L))));
}

}  // namespace cmb::test
