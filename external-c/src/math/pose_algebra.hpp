// Products of poses.
#pragma once

#include <cmath>

#include "math/vector3.hpp"

namespace cmb {

// point_in_outer = compose(outer, inner)(point_in_inner)
inline convex::Pose compose(const convex::Pose &outer, const convex::Pose &inner) {
  const convex::Mat3 axes = transposed(inner.rotation);  // rows: the inner frame's axes
  const convex::Mat3 turned{
      {outer.rotation * axes.row[0], outer.rotation * axes.row[1], outer.rotation * axes.row[2]}};
  return {transposed(turned), outer(inner.translation)};
}

// point_in_a = relative_pose(a, b)(point_in_b), for poses a and b in the same frame.
inline convex::Pose relative_pose(const convex::Pose &a, const convex::Pose &b) {
  const convex::Mat3 to_a = transposed(a.rotation);
  return compose({to_a, {}}, {b.rotation, b.translation - a.translation});
}

// Of an orthonormal rotation the diagonal tells. One comparison, for a branch each costs more.
inline bool is_identity(const convex::Pose &pose) {
  const convex::Mat3 &r = pose.rotation;
  const convex::Vec3 &t = pose.translation;
  return std::fabs(r.row[0].x - 1.0) + std::fabs(r.row[1].y - 1.0) + std::fabs(r.row[2].z - 1.0) + std::fabs(t.x) +
             std::fabs(t.y) + std::fabs(t.z) == 0.0;
}

}  // namespace cmb
