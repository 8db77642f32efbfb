#include "backend/distance_backend.hpp"
#include "geometry/pose_algebra.hpp"

namespace cmb {

std::optional<ConvexAnswer> exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                           BackendScratch &scratch) {
  const convex::SignedDistance answer =
      convex::signed_distance(a.body, b.body, relative_pose(pose_a, pose_b), scratch.distance);
  return ConvexAnswer{answer.distance, pose_a.rotation * answer.normal, pose_a(answer.point_a), pose_a(answer.point_b),
                      answer.proven};
}

}  // namespace cmb
