// How deep an overlap is in a cylinder or cone, by the soft least mean square below its ends and its mantle.
#pragma once

#include "manifold/revolved/overlap_surface.hpp"
#include "manifold/revolved/revolved_body.hpp"

namespace cmb {

using convex::Pose;

// softmin over ends and mantle of (mean of s^2 over the overlap), s being the depth of a place below that side; see DepthBelowFaces. For the
// mantle s^2 is (r^2 - distance^2)^2 by four times the mean of r^2, at a distance from the axis, where the body's radius is r: as good as
// the depth where that is small, and a polynomial, without a corner on the axis.
class DepthInRevolved {
 public:
  // `in_axes`: from the body's frame to the axes of the surface.
  DepthInRevolved(const RevolvedBody &body, const Pose &in_axes, const OverlapSurface &surface);

  double least() const { return least_; }
  // By how much more than in the mean a place of the surface's adds to it: the softmin's derivative by the overlap's volume there, times
  // the volume.
  double excess(const Vec3 &p) const;
  // The mean over the overlap of what the excess changes by the place, and of its moment about the overlap's middle.
  void find_mean_slope(const OverlapSurface &surface, Vec3 &slope, Vec3 &moment) const;

 private:
  enum Side { base, mantle, top, sides };

  // r^2 - distance^2 along the way from the surface's place to another one: quadratic in the part of the way.
  struct Inside {
    double there, first, second;
  };
  Inside inside_along(const Vec3 &p) const;
  double mean_square_in_mantle(const OverlapSurface &surface) const;

  const RevolvedBody body_;
  Vec3 axis_, from_axis_;       // in the surface's axes; of the surface's place, across the axis
  double height_ = 0.0;         // of the surface's place
  double least_ = 0.0, mean_ = 0.0;
  double weight_[sides] = {}, of_radius_ = 0.0;  // of ends' squares, of (r^2 - distance^2)^2, and of r^2
};

}  // namespace cmb
