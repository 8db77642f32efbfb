// Square level sheets, where they cross.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vector3.hpp"

namespace mesh_samples {

// How far the square |x|, |y| <= half of frame `a` reaches beyond the plane z = 0 of `b`, to the side to which it reaches less;
// negative where it lies on one side.
inline double reach_through(const cmb::convex::Pose &a, const cmb::convex::Pose &b, double half) {
  const cmb::convex::Vec3 n = b.rotation.column(2);
  const double across = half * (std::fabs(dot(n, a.rotation.column(0))) + std::fabs(dot(n, a.rotation.column(1))));
  return across - std::fabs(dot(n, a.translation - b.translation));
}

// The squares |x|, |y| <= half of two frames cross along the line in which their planes meet: the least of the length they have
// in common on it and of how far each reaches through the plane of the other one; negative where they are apart. Not for parallel
// planes.
inline double common_extent(const cmb::convex::Pose &a, const cmb::convex::Pose &b, double half) {
  using cmb::convex::Vec3;
  const Vec3 n = a.rotation.column(2), m = b.rotation.column(2), line = normalized(cross(n, m));
  // A point of both planes.
  const double c = dot(n, m), p = dot(n, a.translation), q = dot(m, b.translation), s = norm2(cross(n, m));
  const Vec3 origin = ((p - c * q) / s) * n + ((q - c * p) / s) * m;
  double low = -1e300, high = 1e300;
  for (const cmb::convex::Pose *square : {&a, &b}) {
    for (int axis = 0; axis < 2; ++axis) {
      const Vec3 along = square->rotation.column(axis);
      const double at = dot(along, origin - square->translation), slope = dot(along, line);
      if (slope == 0.0) {
        if (std::fabs(at) > half) return half - std::fabs(at);
        continue;
      }
      const double from = (-half - at) / slope, to = (half - at) / slope;
      low = std::max(low, std::min(from, to));
      high = std::min(high, std::max(from, to));
    }
  }
  return std::min({high - low, reach_through(a, b, half), reach_through(b, a, half)});
}

}  // namespace mesh_samples
