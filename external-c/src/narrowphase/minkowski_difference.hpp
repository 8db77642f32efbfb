// The Minkowski difference A - B of the cores of two bodies, seen through its support function.
#pragma once

#include "shape/convex_body.hpp"

namespace cmb::convex {

// A point a - b of the difference, all in A's frame.
struct DifferencePoint {
  Vec3 w;  // a - b
  Vec3 a;
  Vec3 b;
  std::int32_t vertex_a = -1;  // numbers for polyhedral cores, else -1
  std::int32_t vertex_b = -1;
};

inline bool same_vertices(const DifferencePoint &p, const DifferencePoint &q) {
  if (p.vertex_a < 0 || p.vertex_b < 0) return p.w.x == q.w.x && p.w.y == q.w.y && p.w.z == q.w.z;
  return p.vertex_a == q.vertex_a && p.vertex_b == q.vertex_b;
}

// Borrows both bodies and the pose.
struct MinkowskiDifference {
  const ConvexBody &body_a;
  const ConvexBody &body_b;
  const Pose &b_in_a;
  double scale;  // bounds all coordinates that occur: rounding errors are measured by it

  MinkowskiDifference(const ConvexBody &a, const ConvexBody &b, const Pose &pose)
      : body_a(a), body_b(b), b_in_a(pose), scale(core_radius(a) + core_radius(b) + norm(pose.translation)) {}

  // The farthest point along d.
  DifferencePoint support(const Vec3 &d) const {
    const SupportPoint a = core_support(body_a, d);
    const SupportPoint b = core_support(body_b, -transposed_times(b_in_a.rotation, d));
    const Vec3 b_point = b_in_a(b.point);
    return {a.point - b_point, a.point, b_point, a.vertex, b.vertex};
  }

  // A point that is far along d, though another one may be farther.
  Vec3 outer_point(const Vec3 &d) const {
    const auto outer = [](const ConvexBody &body, const Vec3 &way) {
      if (body.core != CoreShape::polytope) return core_support(body, way).point;
      return body.polytope->vertices()[static_cast<std::size_t>(body.polytope->outer_vertex(way))];
    };
    return outer(body_a, d) - b_in_a(outer(body_b, -transposed_times(b_in_a.rotation, d)));
  }

  // From a point inside B to a point inside A.
  Vec3 center() const { return core_center(body_a) - b_in_a(core_center(body_b)); }
};

}  // namespace cmb::convex
