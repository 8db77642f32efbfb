// Rays on triangles.
#pragma once

#include <limits>

#include "math/vector3.hpp"

namespace cmb::mesh {

using convex::Vec3;

// Where the ray meets the triangle, as a length along the unit direction; infinite where it does not.
inline double ray_hit(const Vec3 &origin, const Vec3 &direction, const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const Vec3 ab = b - a, ac = c - a, p = cross(direction, ac);
  const double determinant = dot(ab, p);
  if (determinant == 0.0) return none;
  const Vec3 from_a = origin - a, q = cross(from_a, ab);
  const double u = dot(from_a, p) / determinant, v = dot(direction, q) / determinant;
  constexpr double slack = 1e-9;  // the ray must not slip through between triangles
  if (u < -slack || v < -slack || u + v > 1.0 + slack) return none;
  const double s = dot(ac, q) / determinant;
  return s >= 0.0 ? s : none;
}

}  // namespace cmb::mesh
