#include "backend/distance_backend.hpp"
#include "geometry/pose_algebra.hpp"

namespace cmb {

std::optional<ConvexAnswer> exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                           BackendScratch &scratch) {
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
