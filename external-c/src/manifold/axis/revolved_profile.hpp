// Distances of places to a cylinder or cone, by what they are nearest to.
#pragma once

#include "shape/convex_body.hpp"

namespace cmb {

// A place relative to the axis of revolution: its distance from it and its height.
struct MeridianPlace {
  double across, height;
};

// The half plane of a place and the axis cuts a rectangle or a triangle out of the body, whose parts are: the base disc and its rim,
// the mantle, the top disc (a cylinder's) and its rim, which is a cone's apex. Inside, the nearest of the sides.
class RevolvedProfile {
 public:
  enum class Part { base, base_rim, mantle, top_rim, top };

  // A cylinder or cone.
  explicit RevolvedProfile(const convex::ConvexBody &body);

  Part nearest(const MeridianPlace &p) const;
  // The signed distance from that part, and its derivatives by the place.
  struct Gap {
    double distance, by_across, by_height;
  };
  Gap gap(Part part, const MeridianPlace &p) const;
  // How far a place is from the rims, and inside from where two sides are as near, counted along the side; not below 0.
  double to_edge(const MeridianPlace &p) const;

  bool is_cylinder() const { return top_ > 0.0; }
  double radius() const { return radius_; }
  double half_length() const { return half_; }
  // Of the mantle, outward, in the half plane: what it has across the axis, and along it.
  double normal_across() const { return normal_across_; }
  double normal_along() const { return normal_along_; }
  // The tangent of half the angle between the normals of base and mantle.
  double base_sharpness() const { return (1.0 + normal_along_) / normal_across_; }

 private:
  double over_mantle(const MeridianPlace &p) const { return (p.across - radius_) * normal_across_ + (p.height + half_) * normal_along_; }
  // Along the mantle, from the base's rim on.
  double along_mantle(const MeridianPlace &p) const { return (p.height + half_) * normal_across_ - (p.across - radius_) * normal_along_; }

  double radius_, half_, top_;  // of the base; of the length; of the top
  double slant_, normal_across_, normal_along_;
};

}  // namespace cmb
