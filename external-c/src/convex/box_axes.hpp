// Two boxes by their fifteen possible separating axes.
#pragma once

#include "vector3.hpp"

namespace cmb::convex {

struct BoxAxes {
  double separation;  // the exact signed distance where negative; else along some axis that parts the boxes
  Vec3 axis;          // unit, from A to B, in A's frame
  Vec3 a, b;          // witness points of the overlap, valid where separation <= 0
};

// Half lengths of both boxes, B's pose in A's frame.
BoxAxes box_axes(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a);

}  // namespace cmb::convex
