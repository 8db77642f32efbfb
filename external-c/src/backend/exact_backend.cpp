#include <algorithm>

#include "backend/distance_backend.hpp"
#include "geometry/pose_algebra.hpp"

namespace cmb {

namespace {

// `if_together` is the normal where the centres coincide.
void between_spheres(double radius_a, const Vec3 &center_a, double radius_b, const Vec3 &center_b,
                     const Vec3 &if_together, ConvexAnswer &answer) {
  const Vec3 apart = center_a - center_b;
  const double length = norm(apart);
  answer.distance = length - radius_a - radius_b;
  answer.normal = length > 0.0 ? (1.0 / length) * apart : if_together;
  answer.point_a = center_a - radius_a * answer.normal;
  answer.point_b = center_b + radius_b * answer.normal;
  answer.mean_normal = answer.normal;
  answer.proven = true;
}

// The place of a capsule's axis nearest to p.
Vec3 nearest_on_axis(const Shape &capsule, const Pose &pose, const Vec3 &p) {
  const Vec3 axis = pose.rotation.column(2);
  const double half = capsule.body.half.z;
  return pose.translation + std::clamp(dot(axis, p - pose.translation), -half, half) * axis;
}

}  // namespace

void find_exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, BackendScratch &scratch,
                         ConvexAnswer &answer) {
  const Vec3 &center_a = pose_a.translation, &center_b = pose_b.translation;
  if (a.kind == ShapeKind::sphere && b.kind == ShapeKind::sphere) {
    between_spheres(a.body.radius, center_a, b.body.radius, center_b, {0, 0, 1}, answer);
    return;
  }
  if (a.kind == ShapeKind::sphere && b.kind == ShapeKind::capsule) {
    between_spheres(a.body.radius, center_a, b.body.radius, nearest_on_axis(b, pose_b, center_a),
                    pose_b.rotation.column(0), answer);
    return;
  }
  if (a.kind == ShapeKind::capsule && b.kind == ShapeKind::sphere) {
    between_spheres(a.body.radius, nearest_on_axis(a, pose_a, center_b), b.body.radius, center_b,
                    pose_a.rotation.column(0), answer);
    return;
  }
  const bool polytopes = a.polytope && b.polytope;
  const convex::SignedDistance found =
      convex::signed_distance(a.body, b.body, relative_pose(pose_a, pose_b), scratch.distance, polytopes);
  answer.distance = found.distance;
  answer.normal = pose_a.rotation * found.normal;
  answer.point_a = pose_a(found.point_a);
  answer.point_b = pose_a(found.point_b);
  answer.proven = found.proven;
  answer.mean_normal = polytopes ? pose_a.rotation * found.mean_normal : answer.normal;
}

std::optional<ConvexAnswer> exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                           BackendScratch &scratch) {
  ConvexAnswer answer;
  find_exact_distance(a, pose_a, b, pose_b, scratch, answer);
  return answer;
}

}  // namespace cmb
