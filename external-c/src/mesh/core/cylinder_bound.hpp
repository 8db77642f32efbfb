// Bounds of surface patches that are thin across: what boxes along fixed axes are not where the patch is slanted.
#pragma once

#include <algorithm>
#include <cmath>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

// A cylinder: all points within `half_thickness` of the plane through `center` across the unit `axis`, and within
// `radius` of the line through it along the axis.
struct CylinderBound {
  Vec3 center, axis;
  double half_thickness = 0.0, radius = 0.0;
};

// The bound seen from another frame.
inline CylinderBound moved(const CylinderBound &bound, const Pose &pose) {
  return {pose(bound.center), pose.rotation * bound.axis, bound.half_thickness, bound.radius};
}

// No more than the distance of what the two hold; 0 where that may be 0.
inline double least_distance(const CylinderBound &a, const CylinderBound &b) {
  const Vec3 apart = b.center - a.center;
  // The sine by the product: from the cosine it would be off by 1e-8 where the axes are nearly parallel.
  const double cosine = std::fabs(dot(a.axis, b.axis)), sine = norm(cross(a.axis, b.axis));
  const double along_a =
      std::fabs(dot(a.axis, apart)) - a.half_thickness - cosine * b.half_thickness - sine * b.radius;
  const double along_b =
      std::fabs(dot(b.axis, apart)) - b.half_thickness - cosine * a.half_thickness - sine * a.radius;
  return std::max(0.0, std::max(along_a, along_b));
}

}  // namespace cmb::mesh
