// Products of poses.
#pragma once

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

}  // namespace cmb
