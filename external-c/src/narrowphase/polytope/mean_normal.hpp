// The surface of the difference C = A - B near the origin, and its mean normal.
//
// Where A and B overlap the origin lies inside C, and the minimum translation ends at the nearest place of C's surface. It
// jumps where two places become equally near. The mean of the surface's normals over the ball of radius
// averaging_radius(depth), each place with the weight (1 - (distance / radius)^2)^2, does not: a convex surface and its
// normals' mean over a ball change continuously with the bodies. Where only one facet meets the ball it is exactly
// that facet's normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/vector3.hpp"
#include "narrowphase/analytic/box_pair.hpp"

namespace cmb::convex {

// How far from the origin parts of the surface have a say where the nearest one is `depth` away, for bodies of `size`:
// 1.5 depths where the overlap is shallow; deeper, the part of the surface that counts stops growing.
inline double averaging_radius(double depth, double size) {
  constexpr double sideways = 1.25;  // 1.5^2 - 1
  constexpr double deep = 0.05;
  const double part = depth / (deep * size);
  return depth * std::sqrt(1.0 + sideways / (1.0 + part * part));
}

// Unit normals that differ by rounding: the square of the difference.
constexpr double same_normal2 = 1e-24;

// The integral of the weight (radius^2 - distance^2)^2 over a facet's part in the ball.
class FacetIntegral {
 public:
  // `normal` unit, outward; the facet's plane is `height` >= 0 from the origin.
  FacetIntegral(const Vec3 &normal, double height, double radius)
      : normal_(normal), height2_(height * height), radius2_(radius * radius), limit2_(radius2_ - height2_) {}

  bool empty() const { return !(limit2_ > 0.0); }
  // The facet's rim: corner(k) for k < count, counter-clockwise about the normal.
  template <typename Corner>
  void add_rim(std::int32_t count, const Corner &corner) {
    const Vec3 *from = &corner(count - 1);
    double from2 = norm2(*from);
    for (std::int32_t k = 0; k < count && !outside_; ++k) {
      const Vec3 *const to = &corner(k);
      const double to2 = norm2(*to);
      add_edge(*from, from2, *to, to2);
      from = to, from2 = to2;
    }
  }
  double value() const;

 private:
  // From p to q, whose squared distances from the origin are given.
  void add_edge(const Vec3 &p, double p2, const Vec3 &q, double q2);
  void add_angle(double sine, double cosine);

  Vec3 normal_;
  double height2_, radius2_, limit2_, sum_ = 0.0;
  // The sum of angles: full turns, and the argument of a complex number.
  double real_ = 1.0, imaginary_ = 0.0, turns_ = 0.0;
  bool all_beyond_ = true, any_angle_ = false;
  bool outside_ = false;  // an edge has the ball wholly beyond it: then the facet, being convex, has no part in it
};

// The sum of the facets' normals times their weights, for two boxes that overlap `depth` (> 0) deep.
Vec3 mean_normal_of_boxes(const BoxPair &boxes, const AcrossEdges &edges, double depth, double size);

}  // namespace cmb::convex
