#include "backend/distance_backend.hpp"

namespace cmb {

std::optional<ConvexAnswer> exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                           BackendScratch &scratch) {
  const Mat3 b_to_world = transposed(pose_b.rotation);  // rows: B's axes in world coordinates
  Pose b_in_a;
  for (int i = 0; i < 3; ++i) {
    // Column i of R_a^T R_b is R_a^T times B's axis i.
    const Vec3 axis = transposed_times(pose_a.rotation, b_to_world.row[i]);
    b_in_a.rotation.row[0].set(i, axis.x);
    b_in_a.rotation.row[1].set(i, axis.y);
    b_in_a.rotation.row[2].set(i, axis.z);
  }
  b_in_a.translation = transposed_times(pose_a.rotation, pose_b.translation - pose_a.translation);
  const convex::SignedDistance answer = convex::signed_distance(a.body, b.body, b_in_a, scratch.distance);
  return ConvexAnswer{answer.distance, pose_a.rotation * answer.normal, pose_a(answer.point_a), pose_a(answer.point_b),
                      answer.proven};
}

}  // namespace cmb
