// The overlap of two shapes, in world axes.
#pragma once

#include "math/pose_algebra.hpp"
#include "shape/shape.hpp"
#include "volume/solid_sums.hpp"

namespace cmb::overlap {

// All zero where there is none. See cmb_overlap.
struct ShapeOverlap {
  double volume = 0.0, patch_area = 0.0;
  Vec3 centroid, patch_centroid;
  Mat3 patch_moment = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
};

// A symmetric tensor in axes that are the columns of `axes`, in the axes these are given in.
inline Mat3 turned(const Mat3 &axes, const Mat3 &tensor) {
  const Mat3 half{{axes * tensor.row[0], axes * tensor.row[1], axes * tensor.row[2]}};
  const Mat3 columns = transposed(half);
  return {{axes * columns.row[0], axes * columns.row[1], axes * columns.row[2]}};
}

// Axes for sums along the unit vector `z`, from `origin`: point_in_world = result(point). y is as near to `y` as can be.
Pose seen_along(const Vec3 &z, const Vec3 &y, const Vec3 &origin);

// From sums in such axes.
ShapeOverlap shape_overlap(const SolidSums &sums, const Pose &axes);

}  // namespace cmb::overlap
