#include "mesh/core/segment_distance.hpp"

#include <cmath>

namespace cmb::mesh {

SegmentPoints nearest_of_segments(const Vec3 &p, const Vec3 &u, const Vec3 &q, const Vec3 &v) {
  const auto limited = [](double x) { return std::fmin(1.0, std::fmax(0.0, x)); };
  const Vec3 r = p - q;
  const double a = norm2(u), e = norm2(v), b = dot(u, v), c = dot(u, r), f = dot(v, r);
  const double determinant = a * e - b * b;
  SegmentPoints result;
  result.s = determinant > 1e-14 * a * e ? limited((b * f - c * e) / determinant) : 0.0;
  const double t = (b * result.s + f) / e;
  result.t = limited(t);
  if (t != result.t) result.s = limited((b * result.t - c) / a);
  result.first = p + result.s * u;
  result.second = q + result.t * v;
  return result;
}

}  // namespace cmb::mesh
