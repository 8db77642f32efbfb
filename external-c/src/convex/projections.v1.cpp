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

// Projections before each attempt of Newton's method.
constexpr int rounds[] = {4, 5, 8};

}  // namespace

Projected distance_by_projections(const MinkowskiDifference &difference, double tolerance, RefinedDirection &result) {
  const Pose &pose = difference.b_in_a;
  const auto to_b = [&pose](const Vec3 &p) { return transposed_times(pose.rotation, p - pose.translation); };
  Vec3 a, b = pose(core_center(difference.body_b));
  for (const int count : rounds) {
    for (int round = 0; round < count; ++round) {
      a = nearest_point(difference.body_a, b);
      b = pose(nearest_point(difference.body_b, to_b(a)));
    }
    const Vec3 gap = b - a;
    const double length = norm(gap);
    if (!(length > 1e-9 * difference.scale)) return Projected::unknown;
    if (!touching_direction(difference, (1.0 / length) * gap, a, b, result)) continue;
    if (!(result.height < 0.0)) return result.height > 0.0 ? Projected::overlapping : Projected::unknown;
    // The height is a lower bound of the distance; points of the bodies as far from each other are an upper one.
    if (outside(difference.body_a, result.a) + outside(difference.body_b, to_b(result.b)) <= tolerance) return Projected::apart;
  }
  return Projected::unknown;
}

}  // namespace cmb::convex
