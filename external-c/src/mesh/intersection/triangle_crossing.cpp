#include "mesh/intersection/triangle_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmb::mesh {

namespace {

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(double x) {
    low = std::fmin(low, x);
    high = std::fmax(high, x);
  }
};

Interval extent(const Vec3 (&corner)[3], const Vec3 &axis, const Vec3 &from) {
  Interval interval;
  for (const Vec3 &p : corner) interval.include(dot(axis, p - from));
  return interval;
}

// How far two intervals reach into each other.
double overlap(const Interval &a, const Interval &b) { return std::fmin(a.high - b.low, b.high - a.low); }

// Where the triangle meets the plane through `from`, as an interval along `line`; `low_at` and `high_at` receive its ends.
// Corners nearer to the plane than `in_plane` lie in it.
Interval on_line(const Vec3 (&corner)[3], const Vec3 &normal, const Vec3 &from, const Vec3 &line, const Vec3 &origin,
                 double in_plane, Vec3 &low_at, Vec3 &high_at) {
  Interval interval;
  const auto include = [&](const Vec3 &at) {
    const double x = dot(line, at - origin);
    if (x < interval.low) low_at = at;
    if (x > interval.high) high_at = at;
    interval.include(x);
  };
  for (int k = 0; k < 3; ++k) {
    const Vec3 &p = corner[k], &q = corner[(k + 1) % 3];
    const double above_p = dot(normal, p - from), above_q = dot(normal, q - from);
    if (std::fabs(above_p) <= in_plane) include(p);
    if ((above_p >= 0.0) != (above_q >= 0.0)) include(p + (above_p / (above_p - above_q)) * (q - p));
  }
  return interval;
}

}  // namespace

TriangleSection common_segment(const Vec3 (&a)[3], const Vec3 &normal_a, const Vec3 (&b)[3], const Vec3 &normal_b,
                               double in_plane) {
  const Vec3 line = cross(normal_a, normal_b);
  Vec3 low_a, high_a, low_b, high_b;
  const Interval first = on_line(a, normal_b, b[0], line, a[0], in_plane, low_a, high_a);
  const Interval second = on_line(b, normal_a, a[0], line, a[0], in_plane, low_b, high_b);
  const Vec3 &low_at = first.low > second.low ? low_a : low_b, &high_at = first.high < second.high ? high_a : high_b;
  const double along = std::fmin(first.high, second.high) - std::fmax(first.low, second.low);
  return {along > 0.0 ? norm(high_at - low_at) : 0.0, 0.5 * (low_at + high_at)};
}

namespace {

// The least that the triangles reach into each other along any axis that may part them, negative where they are apart; as soon as that is not
// more than `enough`, any that is not.
double least_overlap(const Vec3 (&a)[3], const Vec3 &normal_a, const Vec3 (&b)[3], const Vec3 &normal_b, double enough) {
  const Vec3 &origin = a[0];
  double least = std::numeric_limits<double>::infinity();
  const auto still_crosses = [&](const Vec3 &axis) {
    least = std::fmin(least, overlap(extent(a, axis, origin), extent(b, axis, origin)));
    return least > enough;
  };
  if (!still_crosses(normal_a) || !still_crosses(normal_b)) return least;
  for (int i = 0; i < 3; ++i) {
    const Vec3 along = a[(i + 1) % 3] - a[i];
    for (int j = 0; j < 3; ++j) {
      const Vec3 other = b[(j + 1) % 3] - b[j], axis = cross(along, other);
      const double length2 = norm2(axis);
      if (!(length2 > 1e-24 * norm2(along) * norm2(other))) continue;  // parallel: the planes' normals bound it
      if (!still_crosses((1.0 / std::sqrt(length2)) * axis)) return least;
    }
  }
  return least;
}

}  // namespace

TriangleSection triangle_crossing(const Vec3 (&a)[3], const Vec3 &normal_a, const Vec3 (&b)[3], const Vec3 &normal_b,
                                  double enough) {
  const double depth = least_overlap(a, normal_a, b, normal_b, enough);
  if (!(depth > enough)) return {};
  return {depth, common_segment(a, normal_a, b, normal_b, 0.0).place};
}

bool may_meet(const Vec3 (&a)[3], const Vec3 &normal_a, const Vec3 (&b)[3], const Vec3 &normal_b, double rounding) {
  return least_overlap(a, normal_a, b, normal_b, -rounding) > -rounding;
}

}  // namespace cmb::mesh
