#include "backend/distance_backend.hpp"
#include "geometry/pose_algebra.hpp"

namespace cmb {

namespace {

ConvexAnswer between_spheres(double radius_a, const Vec3 &center_a, double radius_b, const Vec3 &center_b) {
  const Vec3 apart = center_a - center_b;
  const double length = norm(apart);
  ConvexAnswer answer;
  answer.distance = length - radius_a - radius_b;
  answer.normal = length > 0.0 ? (1.0 / length) * apart : Vec3{0, 0, 1};
  answer.point_a = center_a - radius_a * answer.normal;
  answer.point_b = center_b + radius_b * answer.normal;
  answer.mean_normal = answer.normal;
  return answer;
}

}  // namespace

std::optional<ConvexAnswer> exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                           BackendScratch &scratch) {
  if (a.kind == ShapeKind::sphere && b.kind == ShapeKind::sphere) {
    return between_spheres(a.body.radius, pose_a.translation, b.body.radius, pose_b.translation);
  }
  const bool polytopes = a.polytope && b.polytope;
  const convex::SignedDistance found =
      convex::signed_distance(a.body, b.body, relative_pose(pose_a, pose_b), scratch.distance, polytopes);
  ConvexAnswer answer;
  answer.distance = found.distance;
  answer.normal = pose_a.rotation * found.normal;
  answer.point_a = pose_a(found.point_a);
  answer.point_b = pose_a(found.point_b);
  answer.proven = found.proven;
  answer.mean_normal = polytopes ? pose_a.rotation * found.mean_normal : answer.normal;
  return answer;
}

}  // namespace cmb
