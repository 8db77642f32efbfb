// How deep a triangle's deepest place lies in a convex polytope.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "math/vector3.hpp"

namespace cmb::mesh {

using convex::Vec3;

// The greatest d for which a place p of the triangle has n . p + d <= offset for all of the polytope's faces: a linear program in three unknowns,
// by the dual simplex method. Not above `enough`, and of no other use, where it is not above that. `near`: a place in the polytope.
// `offset(f)`: of the face whose normal is normals[f].
template <typename Offset>
double deepest_in_polytope(const Vec3 (&corner)[3], const std::vector<Vec3> &normals, const Vec3 &near, double enough, Offset &&offset) {
  const Vec3 across = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double area2 = norm(across);
  if (!(area2 > 0.0)) return 0.0;
  const Vec3 up = (1.0 / area2) * across, origin = near - dot(up, near - corner[0]) * up;
  // Rows a . x <= b, x being a place of the plane from the origin and, along the plane's normal, the depth.
  struct Row {
    Vec3 a;
    double b;
  };
  const auto side = [&](std::size_t k) {
    const Vec3 outward = normalized(cross(corner[(k + 1) % 3] - corner[k], up));
    return Row{outward, dot(outward, corner[k] - origin)};
  };
  const Row sides[3] = {side(0), side(1), side(2)};
  const auto face = [&](std::size_t f) {
    const Vec3 &n = normals[f];
    return Row{n + (1.0 - dot(n, up)) * up, offset(f) - dot(n, origin)};
  };
  const auto row = [&](std::size_t k) { return k < 3 ? sides[k] : face(k - 3); };
  // The first face alone lets the corner be deepest that is farthest from it.
  std::size_t start = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (dot(normals[0], corner[k] - corner[start]) < 0.0) start = k;
  }
  Row rows[3] = {face(0), sides[start], sides[(start + 2) % 3]};  // the sides that meet at the corner
  constexpr double rounding = 1e-13;
  constexpr int most_steps = 100;
  double depth = 0.0;
  for (int step = 0; step < most_steps; ++step) {
    // Columns of the inverse of the rows.
    const Vec3 p = cross(rows[1].a, rows[2].a), q = cross(rows[2].a, rows[0].a), r = cross(rows[0].a, rows[1].a);
    const double scale = 1.0 / dot(rows[0].a, p);
    const Vec3 x = scale * (rows[0].b * p + rows[1].b * q + rows[2].b * r);
    depth = dot(up, x);
    if (!(depth > enough)) return depth;
    std::size_t worst = 0;
    double most = rounding * (norm(x) + std::fabs(rows[0].b) + std::fabs(rows[1].b) + std::fabs(rows[2].b));
    bool beyond = false;
    for (std::size_t k = 0; k < normals.size() + 3; ++k) {
      const Row other = row(k);
      const double by = dot(other.a, x) - other.b;
      if (by > most) worst = k, most = by, beyond = true;
    }
    if (!beyond) return depth;
    const Row entering = row(worst);
    // Multipliers, and how the entering row is made of the basis'.
    const double lambda[3] = {scale * dot(up, p), scale * dot(up, q), scale * dot(up, r)};
    const double part[3] = {scale * dot(entering.a, p), scale * dot(entering.a, q), scale * dot(entering.a, r)};
    std::size_t leaving = 3;
    double least = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(part[k] > rounding)) continue;
      const double ratio = std::fmax(0.0, lambda[k]) / part[k];
      if (leaving == 3 || ratio < least || (ratio == least && part[k] > part[leaving])) leaving = k, least = ratio;
    }
    if (leaving == 3) return 0.0;  // nothing fits: the triangle passes by
    rows[leaving] = entering;
  }
  return depth;
}

}  // namespace cmb::mesh
