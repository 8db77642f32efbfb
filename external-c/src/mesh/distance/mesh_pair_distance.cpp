#include "mesh/distance/mesh_pair_distance.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "mesh/distance/dual_traversal.hpp"
#include "mesh/distance/segment_distance.hpp"

namespace cmb::mesh {

namespace {

// Whether a side of triangle `edges` passes through triangle `face`, and where.
bool pierces(const Vec3 (&edges)[3], const Vec3 (&face)[3], Vec3 &where) {
  const Vec3 n = cross(face[1] - face[0], face[2] - face[0]);
  for (int k = 0; k < 3; ++k) {
    const Vec3 &from = edges[k], &to = edges[(k + 1) % 3];
    const double h0 = dot(n, from - face[0]), h1 = dot(n, to - face[0]);
    if ((h0 > 0.0) == (h1 > 0.0)) continue;
    const Vec3 p = from + (h0 / (h0 - h1)) * (to - from);
    bool inside = true;
    for (int i = 0; i < 3 && inside; ++i) {
      inside = dot(cross(n, face[(i + 1) % 3] - face[i]), p - face[i]) >= 0.0;
    }
    if (inside) {
      where = p;
      return true;
    }
  }
  return false;
}

}  // namespace

TrianglePair triangle_distance(const Vec3 (&a)[3], const Vec3 (&b)[3]) {
  TrianglePair best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec3 &on_a, const Vec3 &on_b) {
    const double distance = norm(on_a - on_b);
    if (!(distance < best.distance)) return;
    best.distance = distance;
    best.on_a = on_a;
    best.on_b = on_b;
  };
  for (int i = 0; i < 3; ++i) {
    offer(a[i], nearest_on_triangle(a[i], b[0], b[1], b[2]).point);
    offer(nearest_on_triangle(b[i], a[0], a[1], a[2]).point, b[i]);
    for (int j = 0; j < 3; ++j) {
      const SegmentPoints points = nearest_of_segments(a[i], a[(i + 1) % 3] - a[i], b[j], b[(j + 1) % 3] - b[j]);
      offer(points.first, points.second);
    }
  }
  Vec3 where;
  if (pierces(a, b, where) || pierces(b, a, where)) {
    best.distance = 0.0;
    best.on_a = best.on_b = where;
  }
  return best;
}

TrianglePair mesh_pair_distance(const TriangleMesh &a, const TriangleMesh &b, const Pose &b_in_a) {
  TrianglePair best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto visit = [&](std::uint32_t number_a, std::uint32_t number_b) {
    const TriangleHierarchy::Node &leaf_a = a.hierarchy().nodes()[number_a], &leaf_b = b.hierarchy().nodes()[number_b];
    for (std::uint32_t j = leaf_b.first; j < leaf_b.first + leaf_b.count; ++j) {
      const std::uint32_t tb = b.hierarchy().order()[j];
      const Vec3 corners_b[3] = {b_in_a(b.corner(tb, 0)), b_in_a(b.corner(tb, 1)), b_in_a(b.corner(tb, 2))};
      const Bounds box_b = bounds_of(corners_b);
      for (std::uint32_t i = leaf_a.first; i < leaf_a.first + leaf_a.count; ++i) {
        const std::uint32_t ta = a.hierarchy().order()[i];
        const Vec3 corners_a[3] = {a.corner(ta, 0), a.corner(ta, 1), a.corner(ta, 2)};
        if (distance2(bounds_of(corners_a), box_b) > best.distance * best.distance) continue;
        TrianglePair pair = triangle_distance(corners_a, corners_b);
        pair.a = ta;
        pair.b = tb;
        // The smallest numbers win a tie, so that the order of the walk does not matter.
        if (pair.distance < best.distance ||
            (pair.distance == best.distance && std::pair(ta, tb) < std::pair(best.a, best.b))) {
          best = pair;
        }
      }
    }
  };
  walk_pairs(a.hierarchy(), b.hierarchy(), b_in_a, [&] { return best.distance * best.distance; }, visit);
  return best;
}

}  // namespace cmb::mesh
