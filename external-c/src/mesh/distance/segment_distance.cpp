#include "mesh/distance/segment_distance.hpp"

#include <cmath>

namespace cmb::mesh {

SegmentPoints nearest_of_segments(const Vec3 &p, const Vec3 &u, const Vec3 &q, const Vec3 &v) {
  const auto limited = [](double x) { return std::fmin(1.0, std::fmax(0.0, x)); };
  const Vec3 r = p - q;
  const double a = norm2(u), e = norm2(v), b = dot(u, v), c = dot(u, r), f = dot(v, r);
  // By products of vectors, which keep the distance to rounding however nearly parallel the segments are: a * e - b * b would not.
  const Vec3 across = cross(u, v);
  const double determinant = norm2(across);
  SegmentPoints result;
  result.s = determinant > 1e-24 * a * e ? limited(dot(cross(v, r), across) / determinant) : 0.0;
  const double t = (b * result.s + f) / e;
  result.t = limited(t);
  if (t != result.t) result.s = limited((b * result.t - c) / a);
  result.first = p + result.s * u;
  result.second = q + result.t * v;
  return result;
}

}  // namespace cmb::mesh
