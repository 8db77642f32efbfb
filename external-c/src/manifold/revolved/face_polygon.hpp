// Whether a place of a plane is in a polygon there.
#pragma once

#include <cstdint>

#include "math/vector3.hpp"

namespace cmb {

// By the border's crossings of a ray. The sides that a place is on would not do: of corners that are one but for rounding the side between
// them has any direction. corner(k): the k-th of `count`, in order.
template <typename Corner>
bool is_in_polygon(std::int32_t count, Corner &&corner, const convex::Vec3 &normal, const convex::Vec3 &at) {
  const convex::Vec3 along = convex::any_perpendicular(normal), across = cross(normal, along);
  bool within = false;
  const convex::Vec3 last = corner(count - 1) - at;
  double x = dot(along, last), y = dot(across, last);
  for (std::int32_t k = 0; k < count; ++k) {
    const convex::Vec3 next = corner(k) - at;
    const double next_x = dot(along, next), next_y = dot(across, next);
    if ((y > 0.0) != (next_y > 0.0) && x + (next_x - x) * (y / (y - next_y)) > 0.0) within = !within;
    x = next_x, y = next_y;
  }
  return within;
}

}  // namespace cmb
