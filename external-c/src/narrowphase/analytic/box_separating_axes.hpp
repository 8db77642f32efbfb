// Two boxes by their fifteen possible separating axes.
#pragma once

#include "narrowphase/analytic/box_pair.hpp"

namespace cmb::convex {

struct BoxAxes {
  double separation;  // the exact signed distance where negative; else along some axis that parts the boxes
  Vec3 axis;          // unit, from A to B, in A's frame
  // Valid where separation <= 0:
  Vec3 a, b;          // witness points of the overlap
};

void find_box_axes(const BoxPair &boxes, BoxAxes &result);

}  // namespace cmb::convex
