// Cylinders and cones by their heights.
#pragma once

#include <cmath>

#include "shape/convex_body.hpp"

namespace cmb {

// In its frame: a place of height z, |z| <= half, is inside where it is no farther from the axis than radius_at(z).
struct RevolvedBody {
  double radius, half;  // of the base, at z = -half
  double slope;         // of the radius by the height; 0 of a cylinder
  double across;        // what the mantle's normal has across the axis

  // A cylinder or cone.
  explicit RevolvedBody(const convex::ConvexBody &body)
      : radius(body.half.x),
        half(body.half.z),
        slope(body.core == convex::CoreShape::cone ? -0.5 * body.half.x / body.half.z : 0.0),
        across(1.0 / std::sqrt(1.0 + slope * slope)) {}

  bool is_cylinder() const { return slope == 0.0; }
  double radius_at(double z) const { return radius + slope * (z + half); }
  // Negative inside of the mantle, at heights up to `half`: the square of the distance from the axis less that of the radius.
  double beyond_mantle(const convex::Vec3 &p) const {
    const double r = radius_at(p.z);
    return p.x * p.x + p.y * p.y - r * r;
  }
};

}  // namespace cmb
