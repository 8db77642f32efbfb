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
  // Of a place on the mantle: of a flat cone's by its distance from the axis, which tells better.
  double height_on_mantle(const convex::Vec3 &p) const { return slope < -1.0 ? half + std::sqrt(p.x * p.x + p.y * p.y) / slope : p.z; }
  // Of a cone's apex: what is nearer may have its border turn in it, as good as.
  double near_apex() const { return 0.02 * (radius + half); }
  bool holds(const convex::Vec3 &p) const { return std::fabs(p.z) <= half && beyond_mantle(p) <= 0.0; }
  // The middle of what the line from `p` along `line` (of any length) has in the body, by that length; false where it misses the body.
  bool middle_of(const convex::Vec3 &p, const convex::Vec3 &line, double &middle) const {
    const double r = radius_at(p.z), growth = slope * line.z;
    double from = -HUGE_VAL, to = HUGE_VAL;  // between the ends
    if (line.z != 0.0) {
      const double at_base = (-half - p.z) / line.z, at_top = (half - p.z) / line.z;
      from = std::fmin(at_base, at_top), to = std::fmax(at_base, at_top);
    } else if (!(std::fabs(p.z) <= half)) {
      return false;
    }
    const double a = line.x * line.x + line.y * line.y - growth * growth, b = p.x * line.x + p.y * line.y - r * growth;
    const double c = beyond_mantle(p), free = b * b - a * c;
    if (a > 0.0) {
      if (!(free > 0.0)) return false;
      const double root = std::sqrt(free);
      from = std::fmax(from, (-b - root) / a), to = std::fmin(to, (root - b) / a);
    } else if (a < 0.0 && free > 0.0) {
      // Outside between the roots; beyond one of them is the part beyond a cone's apex.
      const double root = std::sqrt(free), low = (root - b) / a, high = (-b - root) / a;
      if (line.z > 0.0) {
        to = std::fmin(to, low);
      } else {
        from = std::fmax(from, high);
      }
    }
    middle = 0.5 * (from + to);
    return from < to;
  }
  // Where the ray from `p`, inside, leaves the body, by the ray's length; whether through the mantle.
  double way_out(const convex::Vec3 &p, const convex::Vec3 &ray, bool &through_mantle) const {
    double out = HUGE_VAL;
    if (ray.z > 0.0) out = (half - p.z) / ray.z;
    if (ray.z < 0.0) out = (-half - p.z) / ray.z;
    const double r = radius_at(p.z), growth = slope * ray.z;
    const double a = ray.x * ray.x + ray.y * ray.y - growth * growth, b = p.x * ray.x + p.y * ray.y - r * growth;
    const double c = std::fmin(0.0, beyond_mantle(p)), root = std::sqrt(std::fmax(0.0, b * b - a * c));
    const double through = b > 0.0 ? -c / (b + root) : a > 0.0 ? (root - b) / a : HUGE_VAL;
    through_mantle = through < out;
    return through_mantle ? through : out;
  }
};

}  // namespace cmb
