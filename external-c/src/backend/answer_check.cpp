#include <cmath>

#include "backend/distance_backend.hpp"

namespace cmb {

namespace {

// Extent of a shape along the unit vector d, in world axes.
double extent(const Shape &shape, const Pose &pose, const Vec3 &d) {
  const Vec3 local = transposed_times(pose.rotation, d);
  return dot(d, pose.translation) + dot(local, convex::core_support(shape.body, local).point) + shape.body.radius;
}

}  // namespace

bool answer_holds(const SignedDistance &answer, const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                  double tolerance) {
  if (!std::isfinite(answer.distance) || !is_finite(answer.normal) || !is_finite(answer.point_a) ||
      !is_finite(answer.point_b)) {
    return false;
  }
  if (std::fabs(norm(answer.normal) - 1.0) > 1e-9) return false;
  const double slack = tolerance * (a.bound_radius + b.bound_radius);
  const double along_normal = -(extent(a, pose_a, -answer.normal) + extent(b, pose_b, answer.normal));
  if (std::fabs(along_normal - answer.distance) > slack || (along_normal < 0.0) != (answer.distance < 0.0)) return false;
  return norm(answer.point_a - answer.point_b - answer.distance * answer.normal) <= slack;
}

}  // namespace cmb
