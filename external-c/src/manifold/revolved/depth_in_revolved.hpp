// How deep an overlap is in a cylinder or cone, by the soft least mean square below its ends and its mantle.
#pragma once

#include "manifold/revolved/revolved_body.hpp"
#include "manifold/surface/overlap_surface.hpp"

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
  double excess(const Vec3 &p) const { return excess_at<double>(p, axis_, from_axis_); }
  // Of two places.
  convex::Lanes excess(const convex::LaneVec3 &p) const {
    return excess_at<convex::Lanes>(p, convex::LaneVec3(axis_), convex::LaneVec3(from_axis_));
  }
  // The mean over the overlap of what the excess changes by the place, and of its moment about the overlap's middle.
  void find_mean_slope(const OverlapSurface &surface, Vec3 &slope, Vec3 &moment) const;

 private:
  enum Side { base, mantle, top, sides };

  // r^2 - distance^2 along the way from the surface's place, where it is there_, to another one: quadratic in the part of the way.
  template <typename Number>
  struct Inside {
    Number first, second;
  };
  template <typename Number, typename Place>
  Inside<Number> inside_along(const Place &p, const Number &rise, const Place &from_axis) const {
    return {2.0 * (radius_slope_ * rise - dot(from_axis, p)), (1.0 + slope_square_) * rise * rise - norm2(p)};
  }
  template <typename Number, typename Place>
  Number excess_at(const Place &p, const Place &axis, const Place &from_axis) const {
    const Number rise = dot(axis, p);
    const Inside<Number> way = inside_along(p, rise, from_axis);
    const Number inside = there_ + way.first + way.second;
    return level_ + rise * (growth_ + rise * bend_) + weight_[mantle] * inside * inside;
  }
  double mean_square_in_mantle(const OverlapSurface &surface) const;

  Vec3 axis_, from_axis_;                              // in the surface's axes; of the surface's place, across the axis
  double radius_slope_ = 0.0, slope_square_ = 0.0;     // the radius there by the slope; of the slope
  double there_ = 0.0;
  double least_ = 0.0;
  double weight_[sides] = {};                          // of ends' squares, and of (r^2 - distance^2)^2
  double level_ = 0.0, growth_ = 0.0, bend_ = 0.0;     // of ends' squares and r^2, less the mean, by powers of the rise
};

}  // namespace cmb
