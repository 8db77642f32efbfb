// The surface of the difference C = A - B near the origin, and its mean normal.
//
// Where A and B overlap the origin lies inside C, and the shortest way out ends at the nearest place of C's surface. It
// jumps where two places become equally near. The mean of the surface's normals over the ball of radius
// surface_reach(depth), each place with the weight (1 - (distance / radius)^2)^2, does not: a convex surface and its
// normals' mean over a ball change continuously with the bodies. Where only one facet meets the ball it is exactly
// that facet's normal.
#pragma once

#include <algorithm>
#include <cmath>

#include "box_pair.hpp"
#include "vector3.hpp"

namespace cmb::convex {

// How far from the origin parts of the surface have a say where the nearest one is `depth` away, for bodies of `size`:
// 1.5 depths where the overlap is shallow; deeper, the part of the surface that counts stops growing.
inline double surface_reach(double depth, double size) {
  constexpr double sideways = 1.25;  // 1.5^2 - 1
  constexpr double deep = 0.05;
  const double part = depth / (deep * size);
  return depth * std::sqrt(1.0 + sideways / (1.0 + part * part));
}

// Unit normals that differ by rounding: the square of the difference.
constexpr double same_normal2 = 1e-24;

// The integral of the weight (radius^2 - distance^2)^2 over a facet's part in the ball, given edge by edge.
class FacetIntegral {
 public:
  // `normal` unit, outward; the facet's plane is `height` >= 0 from the origin.
  FacetIntegral(const Vec3 &normal, double height, double radius)
      : normal_(normal), foot_(height * normal), limit2_(radius * radius - height * height) {}

  bool empty() const { return !(limit2_ > 0.0); }
  // The edge from p to q, counter-clockwise about the normal.
  void add_edge(const Vec3 &p, const Vec3 &q);
  // Whether an edge has the ball wholly beyond it: then the facet, being convex, has no part in it.
  bool is_outside() const { return outside_; }
  double value() const;

 private:
  void add_angle(double sine, double cosine);

  Vec3 normal_, foot_;
  double limit2_, sum_ = 0.0;
  // The sum of angles: full turns, and the argument of a complex number.
  double real_ = 1.0, imaginary_ = 0.0, turns_ = 0.0;
  bool all_beyond_ = true, outside_ = false, any_angle_ = false;
};

// The sum of the facets' normals times their weights, for two boxes that overlap `depth` (> 0) deep.
Vec3 nearby_surface_of_boxes(const BoxPair &boxes, const AcrossEdges &edges, double depth, double size);

}  // namespace cmb::convex
