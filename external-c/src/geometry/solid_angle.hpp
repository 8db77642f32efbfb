// Convex cones of directions and their solid angles.
#pragma once

#include <array>
#include <cstddef>

#include "convex/vector3.hpp"

namespace cmb {

using convex::Vec3;

// A convex cone given by its edge rays (any lengths > 0), in turn. Holds up to `capacity` rays; more
// are left out, which costs a sliver of solid angle.
class DirectionCone {
 public:
  static constexpr std::size_t capacity = 128;

  void clear() { count_ = 0; }
  bool empty() const { return count_ < 3; }
  std::size_t size() const { return count_; }
  const Vec3 &operator[](std::size_t i) const { return rays_[i]; }
  void add(const Vec3 &ray) {
    if (count_ < capacity) rays_[count_++] = ray;
  }

  // Solid angle in steradian; 0 where empty.
  double solid_angle() const;

 private:
  std::array<Vec3, capacity> rays_;
  std::size_t count_ = 0;
};

// Solid angle of the cone of three rays (Van Oosterom and Strackee 1983), with the sign of their
// orientation; any lengths > 0.
double triangle_solid_angle(const Vec3 &a, const Vec3 &b, const Vec3 &c);

}  // namespace cmb
