// Axis-parallel bounds of shapes.
#pragma once

#include <cmath>

#include "shape/shape.hpp"

namespace cmb {

// An axis-parallel box in the world.
struct Bounds {
  Vec3 low, high;
};

inline bool overlap(const Bounds &a, const Bounds &b) {
  // Every comparison is made: none is likely to decide alone.
  return (a.low.x <= b.high.x) & (b.low.x <= a.high.x) & (a.low.y <= b.high.y) & (b.low.y <= a.high.y) &
         (a.low.z <= b.high.z) & (b.low.z <= a.high.z);
}

// Of every shape but the half-space, from its geometry and bounding sphere; a parsed shape keeps them.
LocalBounds local_bounds(const Shape &shape);

// Half the extent of local bounds along a direction (unit) given in the shape's frame.
inline double half_extent(const LocalBounds &bounds, const Vec3 &direction) {
  return std::fabs(direction.x) * bounds.half.x + std::fabs(direction.y) * bounds.half.y +
         std::fabs(direction.z) * bounds.half.z + bounds.radius;
}

// Bounds in the world of a shape at `pose`.
inline Bounds world_bounds(const LocalBounds &bounds, const Pose &pose) {
  const Vec3 center = pose(bounds.center);
  const Vec3 half{half_extent(bounds, pose.rotation.row[0]), half_extent(bounds, pose.rotation.row[1]),
                  half_extent(bounds, pose.rotation.row[2])};
  return {center - half, center + half};
}

}  // namespace cmb
