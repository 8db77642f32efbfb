#include "narrowphase/smooth/alternating_projections.hpp"

#include <algorithm>

#include "narrowphase/smooth/feature_direction.hpp"

namespace cmb::convex {

namespace {

// Projects onto a core.
class Projection {
 public:
  explicit Projection(const ConvexBody &body) : core_(body.core), half_(body.half) {
    if (core_ == CoreShape::cone) per_slant2_ = 1.0 / (half_.x * half_.x + 4.0 * half_.z * half_.z);
  }

  // The nearest point to p, both in the core's frame: p itself where it is inside.
  Vec3 operator()(const Vec3 &p) const {
    if (core_ == CoreShape::cylinder) {
      const double across2 = p.x * p.x + p.y * p.y, z = std::clamp(p.z, -half_.z, half_.z);
      const double part = across2 > half_.x * half_.x ? half_.x / std::sqrt(across2) : 1.0;
      return {part * p.x, part * p.y, z};
    }
    if (core_ == CoreShape::cone) return onto_cone(p);
    return {std::clamp(p.x, -half_.x, half_.x), std::clamp(p.y, -half_.y, half_.y), std::clamp(p.z, -half_.z, half_.z)};
  }

 private:
  // In the half plane of the point and the axis the cone is a triangle.
  Vec3 onto_cone(const Vec3 &p) const {
    const double radius = half_.x, height = 2.0 * half_.z, above = p.z + half_.z;
    const double across = std::sqrt(p.x * p.x + p.y * p.y);
    if (above <= 0.0 && across <= radius) return {p.x, p.y, -half_.z};
    if (height * across + radius * (above - height) <= 0.0) return p;
    // Up its side, from the rim (0) to the apex (1).
    const double up = (height * above - radius * (across - radius)) * per_slant2_;
    if (up >= 1.0) return {0.0, 0.0, half_.z};
    const double part = up > 0.0 ? radius * (1.0 - up) / across : radius / across;
    return {part * p.x, part * p.y, up > 0.0 ? height * up - half_.z : -half_.z};
  }

  CoreShape core_;
  Vec3 half_;
  double per_slant2_ = 0.0;
};

}  // namespace

bool direction_by_alternating_projections(const MinkowskiDifference &difference, double part, int rounds,
                                          RefinedDirection &result) {
  const Pose &pose = difference.b_in_a;
  const double whole = 1.0 / part;
  const Projection onto_a(difference.body_a), onto_b(difference.body_b);
  Vec3 a, b, of_b = pose(core_center(difference.body_b));  // of_b: of the shrunk body, a and b: of the whole ones
  for (int round = 0; round < rounds; ++round) {
    a = onto_a(whole * of_b);
    b = onto_b(whole * transposed_times(pose.rotation, part * a - pose.translation));
    of_b = pose(part * b);
  }
  const Vec3 gap = of_b - part * a;
  const double length = norm(gap);
  if (!(length > 1e-9 * difference.scale)) return false;
  return feature_direction(difference, (1.0 / length) * gap, a, b, result);
}

}  // namespace cmb::convex
