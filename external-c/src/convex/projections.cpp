#include "projections.hpp"

#include <algorithm>

#include "touching_direction.hpp"

namespace cmb::convex {

namespace {

// The core's nearest point to p, in the core's frame: p itself where it is inside.
Vec3 nearest_point(const ConvexBody &body, const Vec3 &p) {
  const Vec3 &h = body.half;
  if (body.core == CoreShape::cylinder) {
    const double across2 = p.x * p.x + p.y * p.y, z = std::clamp(p.z, -h.z, h.z);
    const double part = across2 > h.x * h.x ? h.x / std::sqrt(across2) : 1.0;
    return {part * p.x, part * p.y, z};
  }
  if (body.core == CoreShape::cone) {
    const CoreDistance found = distance_of_point(body, p);
    return found.distance > 0.0 ? found.a : p;
  }
  return {std::clamp(p.x, -h.x, h.x), std::clamp(p.y, -h.y, h.y), std::clamp(p.z, -h.z, h.z)};
}

}  // namespace

bool direction_by_projections(const MinkowskiDifference &difference, double part, int rounds, RefinedDirection &result) {
  const Pose &pose = difference.b_in_a;
  const double whole = 1.0 / part;
  Vec3 a, b, of_b = pose(core_center(difference.body_b));  // of_b: of the shrunk body, a and b: of the whole ones
  for (int round = 0; round < rounds; ++round) {
    a = nearest_point(difference.body_a, whole * of_b);
    b = nearest_point(difference.body_b, whole * transposed_times(pose.rotation, part * a - pose.translation));
    of_b = pose(part * b);
  }
  const Vec3 gap = of_b - part * a;
  const double length = norm(gap);
  if (!(length > 1e-9 * difference.scale)) return false;
  return touching_direction(difference, (1.0 / length) * gap, a, b, result);
}

}  // namespace cmb::convex
