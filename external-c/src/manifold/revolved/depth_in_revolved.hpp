// How deep an overlap is in a cylinder or cone, by the soft least mean square below its ends and its mantle.
#pragma once

#include "manifold/revolved/overlap_surface.hpp"
#include "manifold/revolved/revolved_body.hpp"

namespace cmb {

// softmin over ends and mantle of (mean of s^2 over the overlap), s being the depth of a place below that side; see DepthBelowFaces. For the
// mantle s^2 is (r^2 - distance^2)^2 by four times the mean of r^2, at a distance from the axis, where the body's radius is r: as good as
// the depth where that is small, and a polynomial, without a corner on the axis.
class DepthInRevolved {
 public:
  // `surface`: in the body's frame.
  DepthInRevolved(const RevolvedBody &body, const OverlapSurface &surface);

  double least() const { return least_; }
  // By how much more than in the mean a place of the surface's adds to it: the softmin's derivative by the overlap's volume there, times
  // the volume.
  double excess(const Vec3 &p) const;

 private:
  enum Side { base, mantle, top, sides };

  const RevolvedBody body_;
  const Vec3 place_;
  double least_ = 0.0, mean_ = 0.0;
  double weight_[sides] = {}, of_radius_ = 0.0;  // of ends' squares, of (r^2 - distance^2)^2, and of r^2
};

}  // namespace cmb
